#include <gracilis/anatomy/builtin/builtin_hip.hpp>

#include <gracilis/anatomy/builtin/builtin_hip_bones.hpp>
#include <gracilis/anatomy/builtin/builtin_hip_femur.hpp>
#include <gracilis/anatomy/builtin/builtin_hip_muscles.hpp>
#include <gracilis/anatomy/builtin/builtin_hip_pelvis.hpp>
#include <gracilis/anatomy/builtin/builtin_hip_sacrum.hpp>
#include <gracilis/anatomy/builtin/builtin_parts.hpp>

namespace gracilis {

namespace {

using namespace builtin_hip_shapes;

constexpr Index pelvis_body = 0, femur_body = 1;

TriangleMesh mirrored_in_z(TriangleMesh mesh, Real plane_z) {
  mesh.vertices.row(2) = (2 * plane_z - mesh.vertices.row(2).array()).matrix();
  mesh.faces.row(1).swap(mesh.faces.row(2));
  return mesh;
}

Skeleton hip_skeleton() {
  Skeleton skeleton;
  add_bone(skeleton, "hip_bone_r", pelvis_body, right_hip_bone());
  add_bone(skeleton, "sacrum", pelvis_body, sacrum(skeleton.solids[0]));
  add_bone(skeleton, "femur_r", femur_body, right_femur());
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

}  // namespace

Scene builtin_hip_outline(const BuiltinHipOptions& options) {
  Scene scene;
  scene.name = "builtin_hip";
  scene.bodies = {"pelvis", "femur_r"};
  scene.joints = {make_joint()};
  scene.bones = {{"hip_bone_r", pelvis_body, {}},
                 {"sacrum", pelvis_body, {}},
                 {"femur_r", femur_body, {}},
                 {"hip_bone_l", pelvis_body, {}}};
  scene.muscles = outlined_muscles(hip_muscle_plans());
  scene.motion =
      ramp_from_zero("hip flexion", "hip_flexion_r", options.last_flexion, options.flexion_step, options.time_step);
  return scene;
}

Scene builtin_hip(const BuiltinHipOptions& options) {
  Skeleton skeleton = hip_skeleton();
  Scene scene = builtin_hip_outline(options);
  scene.muscles = make_muscles(hip_muscle_plans(), skeleton, {options.bone_gap, options.muscle_gap});
  scene.bones = std::move(skeleton.bones);
  return scene;
}

}  // namespace gracilis
