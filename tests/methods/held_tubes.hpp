#pragma once

#include <gracilis/geometry/signed_distance.hpp>

#include <scenes_for_tests.hpp>

#include <algorithm>
#include <string>

namespace gracilis {

/// A tube of 160 mm, held by a body of its own at either end.
inline Muscle tube_between(const std::string& name, const RigidTransform& place, Index first_body, Index around) {
  Muscle muscle;
  muscle.name = name;
  muscle.surface = shapes::cylinder(0.01, 0.16, around, 2 * around);
  muscle.surface.vertices.row(2).array() -= 0.08;
  Attachment origin{"one end", AttachmentEnd::origin, first_body, {}, false};
  Attachment insertion{"other end", AttachmentEnd::insertion, first_body + 1, {}, false};
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
    if (muscle.surface.vertices(2, v) > 0.07) origin.vertices.push_back(v);
    if (muscle.surface.vertices(2, v) < -0.07) insertion.vertices.push_back(v);
  }
  muscle.attachments = {origin, insertion};
  muscle.surface.vertices = (place.linear() * muscle.surface.vertices).colwise() + place.translation();
  return muscle;
}

/// Two tubes that cross each other in their middles, `gap` apart.
inline Scene held_tubes_across(Real gap, Index around = 24) {
  Scene scene;
  scene.name = "crossing";
  scene.bodies = {"a", "b", "c", "d"};
  const RigidTransform across = Eigen::Translation3d(0.02 + gap, 0, 0) * Eigen::AngleAxisd(pi / 2, Vec3::UnitX());
  scene.muscles = {tube_between("still", RigidTransform::Identity(), 0, around),
                   tube_between("moved", across, 2, around)};
  scene.method.name = "tissue";
  scene.method.settings = {{"minimizer_iterations", 60}, {"tension_frames", 1}};
  return scene;
}

/// How deep the deepest vertex of one is in the other, m.
inline Real depth(const Points& one, const Points& other, const Eigen::Matrix3Xi& faces_of_other) {
  const SignedDistance distance({other, faces_of_other});
  Real deepest = 0;
  for (const Vec3& p : one.colwise()) deepest = std::max(deepest, -distance.query(p).distance);
  return deepest;
}

/// The same of a frame's muscles.
inline Real depth(const Scene& scene, const Frame& frame, std::size_t one, std::size_t other) {
  return depth(frame.muscles[one].points, frame.muscles[other].points, scene.muscles[other].surface.faces);
}

}  // namespace gracilis
