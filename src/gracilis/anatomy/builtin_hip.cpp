#include <gracilis/anatomy/builtin_hip.hpp>

#include <gracilis/anatomy/builtin_hip_bones.hpp>
#include <gracilis/anatomy/builtin_hip_muscles.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/surface_extraction.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

using namespace builtin_hip_shapes;

constexpr Index pelvis_body = 0, femur_body = 1;
constexpr Real attachment_reach = 0.0042;  ///< m; what is closer to the bone grows on it

TriangleMesh mirrored_in_z(TriangleMesh mesh, Real plane_z) {
  mesh.vertices.row(2) = (2 * plane_z - mesh.vertices.row(2).array()).matrix();
  mesh.faces.row(1).swap(mesh.faces.row(2));
  return mesh;
}

/// The bones' surfaces, and the same as obstacles for muscles.
struct Skeleton {
  std::vector<Bone> bones;
  std::vector<ImplicitSolid> solids;
};

Skeleton make_skeleton() {
  constexpr Real step = 0.002, edge = 0.0033;
  Skeleton skeleton;
  const auto add = [&](const char* name, Index body, const ImplicitSolid& solid) {
    SampledSolid sampled = sample(solid, step);
    skeleton.bones.push_back({name, body, remesh(largest_component(extract_surface(sampled)), sampled, edge)});
    skeleton.solids.push_back(as_solid(std::move(sampled)));
  };
  add("hip_bone_r", pelvis_body, right_hip_bone());
  add("sacrum", pelvis_body, sacrum(skeleton.solids[0]));
  add("femur_r", femur_body, right_femur());
  skeleton.bones.push_back({"hip_bone_l", pelvis_body, mirrored_in_z(skeleton.bones[0].surface, median_plane)});
  skeleton.solids.push_back(mirrored_in_z(skeleton.solids[0], median_plane));
  return skeleton;
}

Joint make_joint() {
  Joint joint{"hip_r", pelvis_body, femur_body, RigidTransform::Identity(), {}};
  // Ranges of passive motion in healthy adults.
  joint.axes = {{"hip_flexion_r", Vec3::UnitZ(), 0, radians(-30), radians(120)},
                {"hip_adduction_r", Vec3::UnitX(), 0, radians(-45), radians(30)},
                {"hip_rotation_r", Vec3::UnitY(), 0, radians(-45), radians(45)}};
  return joint;
}

Motion make_motion(const BuiltinHipOptions& options) {
  const Index rows = static_cast<Index>(std::floor(options.last_flexion / options.flexion_step + 1e-9)) + 1;
  Motion motion{"hip flexion", {"hip_flexion_r"}, {}, Eigen::MatrixXd(rows, 1)};
  for (Index row = 0; row < rows; ++row) {
    motion.times.push_back(row * options.time_step);
    motion.values(row, 0) = row * options.flexion_step;
  }
  return motion;
}

/// Marks the vertices of `muscle` that grow on bone: near a bone of the body, and in the part of the sheet that is this
/// end.
std::vector<Attachment> attach(const MusclePlan& plan, const TriangleMesh& surface, const std::vector<Bone>& bones,
                               const std::vector<NearestTriangle>& nearest) {
  std::vector<Attachment> attachments = {{"origin", AttachmentEnd::origin, pelvis_body, {}, false},
                                         {"insertion", AttachmentEnd::insertion, femur_body, {}, false}};
  const ThickSheet sheet(plan.net);
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    const Vec3 point = surface.vertices.col(v);
    const Real along = sheet.nearest(point).along;
    if (along > plan.origin_until && along < plan.insertion_from) continue;
    Attachment& attachment = attachments[along > plan.origin_until ? 1 : 0];
    for (std::size_t b = 0; b < bones.size(); ++b)
      if (bones[b].body == attachment.body && nearest[b].query(point, attachment_reach).face >= 0) {
        attachment.vertices.push_back(v);
        break;
      }
  }
  return attachments;
}

std::vector<Muscle> make_muscles(const Skeleton& skeleton, const BuiltinHipOptions& options) {
  std::vector<Obstacle> obstacles;
  for (const ImplicitSolid& solid : skeleton.solids) obstacles.push_back({solid, options.bone_gap});
  std::vector<NearestTriangle> nearest;
  for (const Bone& bone : skeleton.bones) nearest.emplace_back(bone.surface);

  std::vector<Muscle> muscles;
  for (const MusclePlan& plan : muscle_plans()) {
    ShapedMuscle shaped = shape_muscle(plan, obstacles);
    obstacles.push_back({as_solid(std::move(shaped.shape)), options.muscle_gap});
    Muscle muscle;
    muscle.name = plan.name;
    muscle.xpbd.iterations = plan.iterations;
    muscle.attachments = attach(plan, shaped.surface, skeleton.bones, nearest);
    muscle.surface = std::move(shaped.surface);
    muscles.push_back(std::move(muscle));
  }
  return muscles;
}

}  // namespace

Scene builtin_hip(const BuiltinHipOptions& options) {
  Skeleton skeleton = make_skeleton();
  Scene scene;
  scene.name = "builtin_hip";
  scene.bodies = {"pelvis", "femur_r"};
  scene.joints = {make_joint()};
  scene.muscles = make_muscles(skeleton, options);
  scene.bones = std::move(skeleton.bones);
  scene.motion = make_motion(options);
  return scene;
}

}  // namespace gracilis
