#include <gracilis/view/pictures/preview.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/io/run/run_folder.hpp>
#include <gracilis/view/pictures/muscle_look.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace gracilis {

std::string words_of_name(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

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

/// The middle of the bones of a body at the capture pose; of all bones when it has none.
static Vec3 middle_of_body(const Scene& scene, Index body) {
  Eigen::AlignedBox3d box, all;
  for (const Bone& bone : scene.bones) {
    const Eigen::AlignedBox3d extent(bone.surface.vertices.rowwise().minCoeff(),
                                     bone.surface.vertices.rowwise().maxCoeff());
    all.extend(extent);
    if (bone.body == body) box.extend(extent);
  }
  return box.isEmpty() ? all.center() : box.center();
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

CameraDirection preview_camera(const Scene& scene, const std::vector<Pose>& poses) {
  CameraDirection panel;
  const TurningAxis turning = main_axis(scene, poses);
  if (!turning.joint) return panel;
  const Joint& joint = *turning.joint;
  const Vec3 center = joint.frame.translation();
  panel.up = snapped_to_axis(center - middle_of_body(scene, joint.child_body));
  Vec3 axis = joint.frame.linear() * turning.axis->axis;
  if (std::abs(axis.dot(panel.up)) > 0.7) axis = joint.frame.linear() * joint.axes[0].axis;
  if (std::abs(axis.dot(panel.up)) > 0.7) axis = panel.up.unitOrthogonal();
  axis = (axis - axis.dot(panel.up) * panel.up).normalized();
  // The joint lies outwards from the middle of the resting body: look from there inwards.
  const Vec3 outwards = center - middle_of_body(scene, joint.parent_body);
  panel.looking = snapped_to_axis(axis.dot(outwards) > 0 ? Vec3(-axis) : axis);
  return panel;
}

static std::vector<Pose> poses_of(const std::vector<Frame>& frames) {
  std::vector<Pose> poses;
  for (const Frame& frame : frames) poses.push_back(frame.pose);
  return poses;
}

/// Frames before the motion have times that say nothing.
static std::string time_caption(const Scene& scene, const Frame& frame) {
  const bool before = scene.motion.times.empty() || frame.pose.time < scene.motion.times.front();
  if (before) return fmt::format("frame {}, on the way to the motion", frame.number);
  return fmt::format("frame {}, {:.2f} s", frame.number, frame.pose.time);
}

/// The coordinates that left the capture pose, unless they went to 0: a motion of one coordinate sets the others there.
static std::string caption_of(const Scene& scene, const Frame& frame) {
  if (frame.number == 0) return "capture pose";
  std::string caption;
  std::size_t coordinate = 0;
  int shown_coordinates = 0;
  for (const Joint& joint : scene.joints) {
    for (const JointAxis& axis : joint.axes) {
      if (coordinate >= frame.pose.coordinates.size()) break;
      const Real value = frame.pose.coordinates[coordinate++];
      const Real shown = shown_value(axis, value);
      if (std::abs(shown - shown_value(axis, axis.capture_value)) < 0.5 || std::abs(shown) < 0.5) continue;
      // A whole body has more coordinates than a caption has room.
      if (++shown_coordinates > 3) return time_caption(scene, frame);
      caption += fmt::format("{}{} {:.0f}{}", caption.empty() ? "" : ", ", axis.coordinate, shown,
                             axis.translation ? " mm" : "°");
    }
  }
  return caption.empty() ? fmt::format("frame {}", frame.number) : caption;
}

Picture preview_picture(const Scene& scene, const std::vector<Frame>& frames) {
  Picture picture;
  picture.title = scene.name;
  const CameraDirection camera = preview_camera(scene, poses_of(frames));
  Panel aimed;
  aimed.looking = camera.looking;
  aimed.up = camera.up;
  std::vector<MuscleLook> looks;
  for (const Muscle& muscle : scene.muscles) looks.push_back(muscle_look(muscle));
  for (const Frame& frame : frames) {
    Panel panel = aimed;
    panel.caption = caption_of(scene, frame);
    for (const Bone& bone : scene.bones) {
      const RigidTransform& motion = frame.pose.bodies[static_cast<std::size_t>(bone.body)];
      panel.surfaces.push_back({"", {motion * bone.surface.vertices, bone.surface.faces}});
    }
    for (std::size_t i = 0; i < scene.muscles.size(); ++i) {
      const Muscle& muscle = scene.muscles[i];
      PaintedSurface surface{"", {frame.muscles[i].points, muscle.surface.faces}};
      surface.colors = painted_tissue(looks[i], muscle.name);
      surface.stripes = looks[i].stripes;
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
  render_picture(preview_picture(scene, frames), run_folder / "preview.png");
}

}  // namespace gracilis
