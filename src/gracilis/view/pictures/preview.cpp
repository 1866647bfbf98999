#include <gracilis/view/pictures/preview.hpp>

#include <gracilis/core/words_of_name.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/io/run/run_folder.hpp>
#include <gracilis/view/pictures/evened_surface.hpp>
#include <gracilis/view/pictures/muscle_look.hpp>
#include <gracilis/view/pictures/pose_caption.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace gracilis {

static Real distance_from_capture(const std::vector<Pose>& poses, std::size_t i) {
  Real largest = 0;
  for (std::size_t k = 0; k < poses[i].coordinates.size(); ++k) {
    largest = std::max(largest, std::abs(poses[i].coordinates[k] - poses[0].coordinates[k]));
  }
  return largest;
}

std::vector<int> preview_frames(const std::vector<Pose>& poses, int frame_count) {
  const auto count = std::min(poses.size(), static_cast<std::size_t>(std::max(frame_count, 0)));
  if (count == 0) return {};
  std::size_t farthest = 0;
  for (std::size_t i = 1; i < count; ++i) {
    if (distance_from_capture(poses, i) > distance_from_capture(poses, farthest)) farthest = i;
  }
  std::size_t half = 0;
  while (distance_from_capture(poses, half) < distance_from_capture(poses, farthest) / 2) ++half;
  std::vector<int> frames = {0, static_cast<int>(half), static_cast<int>(farthest)};
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

/// The middle of the bones of a body in the capture pose, or of all bones; nothing where it has none.
static std::optional<Vec3> middle_of_bones(const Scene& scene, std::optional<Index> body = {}) {
  Eigen::AlignedBox3d box;
  for (const Bone& bone : scene.bones) {
    if (body && bone.body != *body) continue;
    box.extend(bounding_box(bone.surface.vertices));
  }
  if (box.isEmpty()) return std::nullopt;
  return box.center();
}

/// Nearly upright is upright: bodies stand along the axes of their frame.
static Vec3 snapped_to_axis(const Vec3& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  Vec3 snapped = Vec3::Zero();
  snapped[axis] = direction[axis] > 0 ? 1 : -1;
  return snapped.dot(direction.normalized()) > std::cos(radians(35)) ? snapped : direction.normalized();
}

namespace {

struct TurningAxis {
  const Joint* joint = nullptr;
  const JointAxis* axis = nullptr;
};

}  // namespace

/// The axis whose coordinate varies most over the frames.
static TurningAxis main_axis(const Scene& scene, const std::vector<Pose>& poses) {
  TurningAxis found;
  Real largest = -1;
  std::size_t coordinate = 0;
  for (const Joint& joint : scene.joints) {
    for (const JointAxis& axis : joint.axes) {
      Real low = axis.capture_value, high = low;
      for (const Pose& pose : poses) {
        if (coordinate >= pose.coordinates.size()) continue;
        low = std::min(low, pose.coordinates[coordinate]);
        high = std::max(high, pose.coordinates[coordinate]);
      }
      if (high - low > largest) {
        largest = high - low;
        found = {&joint, &axis};
      }
      ++coordinate;
    }
  }
  return found;
}

/// Away from the moving bones; the subject's own where there are none, or they lie about the joint.
static Vec3 up_of(const Scene& scene, const Joint& joint) {
  constexpr Real least_way = 1e-3;  // m
  const Vec3 center = joint.frame.translation(),
             up = center - middle_of_bones(scene, joint.child_body).value_or(center);
  return up.norm() < least_way ? scene.axes.superior : snapped_to_axis(up);
}

CameraDirection preview_camera(const Scene& scene, const std::vector<Pose>& poses) {
  const TurningAxis turning = main_axis(scene, poses);
  if (!turning.joint) return {-scene.axes.right(), scene.axes.superior};
  const Joint& joint = *turning.joint;
  CameraDirection camera;
  camera.up = up_of(scene, joint);
  Vec3 axis = joint.frame.linear() * turning.axis->axis;
  if (std::abs(axis.dot(camera.up)) > 0.7) axis = joint.frame.linear() * joint.axes[0].axis;
  if (std::abs(axis.dot(camera.up)) > 0.7) axis = camera.up.unitOrthogonal();
  axis = (axis - axis.dot(camera.up) * camera.up).normalized();
  // The joint lies outwards from the middle of the resting body: look from there inwards.
  const std::optional<Vec3> parent = middle_of_bones(scene, joint.parent_body);
  const Vec3 outwards = joint.frame.translation() - (parent ? *parent : middle_of_bones(scene).value_or(Vec3::Zero()));
  camera.looking = snapped_to_axis(axis.dot(outwards) > 0 ? Vec3(-axis) : axis);
  return camera;
}

Picture preview_picture(const Scene& scene, const std::vector<Pose>& poses, const std::vector<Frame>& frames) {
  Picture picture;
  picture.title = words_of_name(scene.name);
  const CameraDirection camera = preview_camera(scene, poses);
  const CaptionedFrames captions = captioned_frames(scene, poses);
  Panel aimed;
  aimed.looking = camera.looking;
  aimed.up = camera.up;
  std::vector<MuscleLook> looks;
  std::vector<EvenedSurface> evened;
  for (const Muscle& muscle : scene.muscles) {
    looks.push_back(muscle_look(muscle));
    evened.emplace_back(muscle.surface);
  }
  for (const Frame& frame : frames) {
    Panel panel = aimed;
    panel.caption = pose_caption(captions, frame.number);
    for (const Bone& bone : scene.bones) {
      const RigidTransform& motion = frame.pose.bodies[static_cast<std::size_t>(bone.body)];
      panel.surfaces.push_back({"", {motion * bone.surface.vertices, bone.surface.faces}});
    }
    for (std::size_t i = 0; i < scene.muscles.size(); ++i) {
      const Muscle& muscle = scene.muscles[i];
      PaintedSurface surface{"", {frame.muscles[i].points, muscle.surface.faces}};
      surface.colors = natural_colors(looks[i], muscle.name);
      surface.stripes = looks[i].stripes;
      surface.mesh.vertices = evened[i].of(surface.mesh.vertices);
      panel.surfaces.push_back(std::move(surface));
    }
    picture.panels.push_back(panel);
  }
  return picture;
}

void write_preview(const std::filesystem::path& run_folder, const Scene& scene, const std::vector<Pose>& poses) {
  std::vector<Frame> frames;
  for (const int number : preview_frames(poses, count_frames(run_folder, scene))) {
    frames.push_back(read_frame(run_folder, scene, number, poses[static_cast<std::size_t>(number)]));
  }
  render_picture(preview_picture(scene, poses, frames), run_folder / "preview.png");
}

}  // namespace gracilis
