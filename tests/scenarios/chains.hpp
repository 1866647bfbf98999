#pragma once

#include <gracilis/scene/scene.hpp>

#include <shapes.hpp>

#include <string>
#include <utility>
#include <vector>

/// Limbs of several bones one below the other, with muscles wherever they are wanted.
namespace gracilis::chains {

inline TriangleMesh shaft(Real top, Real bottom, Real radius = 0.01, const Vec3& beside = Vec3::Zero()) {
  TriangleMesh bone = shapes::cylinder(radius, top - bottom, 20, static_cast<int>(std::ceil((top - bottom) / 0.01)));
  bone.vertices.colwise() += beside + Vec3(0, 0, bottom);
  return bone;
}

inline Joint hinge(const std::string& coordinate, Index parent, Index child, const Vec3& center) {
  Joint joint{coordinate + "_joint",
              parent,
              child,
              RigidTransform::Identity(),
              {{coordinate, Vec3::UnitY(), 0, -radians(150), radians(150)}}};
  joint.frame.translation() = center;
  return joint;
}

/// Three shafts that hang from each other, hinged about y: thigh (from 0.605 to 0.305 m), shank (0.295 to 0.005) and
/// foot (-0.005 to -0.1). A positive turn swings what hangs below towards -x.
inline Scene three_shafts() {
  Scene scene;
  scene.name = "chain";
  scene.bodies = {"thigh", "shank", "foot"};
  scene.bones = {
      {"thigh", 0, shaft(0.605, 0.305)}, {"shank", 1, shaft(0.295, 0.005)}, {"foot", 2, shaft(-0.005, -0.1)}};
  scene.joints = {hinge("knee", 0, 1, {0, 0, 0.3}), hinge("ankle", 1, 2, {0, 0, 0})};
  return scene;
}

/// What holds a muscle between two heights: a body, or none.
struct Hold {
  AttachmentEnd end;
  Index body;
  Real from, to;  ///< m, along z
};

/// A spindle along z from `bottom` to `top` beside the bones, attached where it is held.
inline Muscle spindle(const std::string& name, Real top, Real bottom, Real x, const std::vector<Hold>& holds,
                      Real radius = 0.012) {
  Muscle muscle;
  muscle.name = name;
  const Real length = top - bottom;
  muscle.surface = shapes::cylinder(1, length, 20, static_cast<int>(std::round(length / 0.005)));
  for (auto p : muscle.surface.vertices.colwise()) {
    const Real along = p.z() / length, wide = radius * (0.6 + 0.4 * std::sin(pi * along));
    p = Vec3(wide * p.x() + x, 1.2 * wide * p.y(), p.z() + bottom);
  }
  for (const Hold& hold : holds) {
    Attachment attachment{"at " + std::to_string(hold.from), hold.end, hold.body, {}, false};
    for (Index v = 0; v < muscle.surface.vertex_count(); ++v)
      if (const Real z = muscle.surface.vertices(2, v); z >= hold.from - 1e-9 && z <= hold.to + 1e-9)
        attachment.vertices.push_back(v);
    muscle.attachments.push_back(attachment);
  }
  return muscle;
}

/// The coordinates of all joints from 0 to `last` (degrees) in steps of at most `step` degrees, and back if asked for.
inline Scene moving(Scene scene, const std::vector<Real>& last, bool back = false, Real step = 2) {
  scene.motion.name = "motion";
  scene.motion.coordinates.clear();
  Real largest = 0;
  for (const Real each : last) largest = std::max(largest, std::abs(each));
  const auto rows = static_cast<Index>(std::ceil(largest / step)) + 1, all = back ? 2 * rows - 1 : rows;
  scene.motion.values.resize(all, static_cast<Index>(last.size()));
  scene.motion.times.clear();
  for (Index i = 0; i < all; ++i) {
    scene.motion.times.push_back(static_cast<Real>(i) / 60);
    const Real share = static_cast<Real>(i < rows ? i : all - 1 - i) / static_cast<Real>(rows - 1);
    for (std::size_t k = 0; k < last.size(); ++k)
      scene.motion.values(i, static_cast<Index>(k)) = share * radians(last[k]);
  }
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes) scene.motion.coordinates.push_back(axis.coordinate);
  return scene;
}

}  // namespace gracilis::chains
