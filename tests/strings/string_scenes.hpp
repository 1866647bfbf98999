#pragma once

#include <gracilis/anatomy/overlap/bone_field.hpp>
#include <gracilis/strings/muscle_strings.hpp>

#include <scenes_for_tests.hpp>

#include <vector>

/// Small joints whose muscles are laid out as strings.
namespace gracilis::strings {

/// A long bone that stands up, a short one hinged behind its lower end, and a tube of muscle along the front of the
/// long one down to the short one: an arm whose belly must stay where it is while its tendon bends with the joint.
inline Scene arm_scene(const Vec3& away = Vec3::Zero()) {
  Scene scene;
  scene.name = "arm";
  scene.bodies = {"upper", "lower"};
  scene.bones = {{"upper", 0, shapes::cylinder(0.01, 0.3, 24, 40)}, {"lower", 1, shapes::cylinder(0.01, 0.1, 24, 20)}};
  scene.bones[0].surface.vertices.colwise() += Vec3(0, 0, 0.005);
  scene.bones[1].surface.vertices.colwise() += Vec3(0, 0, -0.105);
  scene.joints = {{"hinge", 0, 1, RigidTransform::Identity(), {{"flexion", Vec3::UnitY(), 0, 0, radians(120)}}}};
  scene.joints[0].frame = Eigen::Translation3d(away) * RigidTransform::Identity();
  Muscle muscle;
  muscle.name = "flexor";
  muscle.surface = shapes::cylinder(0.012, 0.32, 24, 64);
  muscle.surface.vertices.colwise() += Vec3(-0.024, 0, -0.05);
  Attachment origin{"top", AttachmentEnd::origin, 0, {}, false};
  Attachment insertion{"bottom", AttachmentEnd::insertion, 1, {}, false};
  const Real top = muscle.surface.vertices.row(2).maxCoeff(), bottom = muscle.surface.vertices.row(2).minCoeff();
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
    const Real z = muscle.surface.vertices(2, v);
    if (z > top - 0.01) origin.vertices.push_back(v);
    if (z < bottom + 0.01) insertion.vertices.push_back(v);
  }
  muscle.attachments = {origin, insertion};
  scene.muscles = {muscle};
  for (Bone& bone : scene.bones) bone.surface.vertices.colwise() += away;
  scene.muscles[0].surface.vertices.colwise() += away;
  return scene;
}

/// Per vertex of a muscle: the body that it is attached to, or -1.
inline std::vector<Index> attached_bodies(const Muscle& muscle) {
  std::vector<Index> bodies(static_cast<std::size_t>(muscle.surface.vertex_count()), -1);
  for (const Attachment& attachment : muscle.attachments)
    for (const Index v : attachment.vertices) bodies[static_cast<std::size_t>(v)] = attachment.body;
  return bodies;
}

/// A scene's first muscle as strings, with all that it needs.
struct Strung {
  explicit Strung(Scene given) : scene(std::move(given)) {
    for (const Bone& bone : scene.bones) fields.push_back(build_bone_field(bone, far_field_settings()));
    bones = bone_distances(scene, fields);
    muscle = *muscle_strings(scene, scene.muscles.front(), bones, {});
  }
  Strung(const Strung&) = delete;

  Scene scene;
  std::vector<DistanceField> fields;
  BoneDistances bones;
  MuscleStrings muscle;
};

}  // namespace gracilis::strings
