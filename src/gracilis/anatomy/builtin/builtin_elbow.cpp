#include <gracilis/anatomy/builtin/builtin_elbow.hpp>

#include <gracilis/anatomy/builtin/builtin_elbow_bones.hpp>
#include <gracilis/anatomy/builtin/builtin_elbow_forearm.hpp>
#include <gracilis/anatomy/builtin/builtin_elbow_humerus.hpp>
#include <gracilis/anatomy/builtin/builtin_elbow_muscles.hpp>
#include <gracilis/anatomy/builtin/builtin_elbow_scapula.hpp>
#include <gracilis/anatomy/builtin/builtin_parts.hpp>

namespace gracilis {

namespace {

using namespace builtin_elbow_shapes;

constexpr Index scapula_body = 0, humerus_body = 1, ulna_body = 2, radius_body = 3;

Skeleton elbow_skeleton() {
  Skeleton skeleton;
  add_bone(skeleton, "scapula_r", scapula_body, right_scapula());
  add_bone(skeleton, "humerus_r", humerus_body, right_humerus());
  add_bone(skeleton, "ulna_r", ulna_body, right_ulna());
  add_bone(skeleton, "radius_r", radius_body, right_radius());
  return skeleton;
}

RigidTransform placed_at(const Vec3& center) { return RigidTransform(Eigen::Translation3d(center)); }

std::vector<Joint> make_joints() {
  Joint shoulder{"shoulder_r", scapula_body, humerus_body, placed_at(humeral_head), {}};
  shoulder.axes = {{"shoulder_flexion", Vec3::UnitZ(), 0, radians(-20), radians(30)}};
  Joint elbow{"elbow_r", humerus_body, ulna_body, RigidTransform::Identity(), {}};
  elbow.axes = {{"elbow_flexion", Vec3::UnitZ(), 0, 0, radians(130)}};
  Joint radioulnar{"radioulnar_r", ulna_body, radius_body, placed_at(radial_head), {}};
  radioulnar.axes = {{"pro_sup", Vec3::UnitY(), radians(-90), radians(-90), radians(80)}};
  return {shoulder, elbow, radioulnar};
}

}  // namespace

Scene builtin_elbow_outline(const BuiltinElbowOptions& options) {
  Scene scene;
  scene.name = "builtin_elbow";
  scene.bodies = {"scapula_r", "humerus_r", "ulna_r", "radius_r"};
  scene.joints = make_joints();
  for (Index body = scapula_body; body <= radius_body; ++body)
    scene.bones.push_back({scene.bodies[static_cast<std::size_t>(body)], body, {}});
  scene.muscles = outlined_muscles(elbow_muscle_plans());
  scene.motion = ramp_from_zero("elbow flexion", "elbow_flexion", options.last_flexion, options.flexion_step, 1.0 / 60);
  return scene;
}

Scene builtin_elbow(const BuiltinElbowOptions& options) {
  Skeleton skeleton = elbow_skeleton();
  Scene scene = builtin_elbow_outline(options);
  scene.muscles = make_muscles(elbow_muscle_plans(), skeleton, {});
  scene.bones = std::move(skeleton.bones);
  return scene;
}

}  // namespace gracilis
