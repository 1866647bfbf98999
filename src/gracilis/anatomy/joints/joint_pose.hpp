#pragma once

#include <gracilis/scene/pose.hpp>
#include <gracilis/scene/scene.hpp>

#include <span>
#include <string>
#include <vector>

namespace gracilis {

/// The coordinates of all axes of all joints, in the order that Pose::coordinates uses.
std::vector<std::string> coordinate_names(const Scene& scene);

/// Their values at which the meshes were captured, rad (m for translations).
std::vector<Real> capture_coordinates(const Scene& scene);

/// Where every body is when the coordinates have these values (rad, m for translations; in the order of
/// `coordinate_names`).
///
/// A body's transform carries it from its place in the capture pose:
/// \f$T_{child} = T_{parent} P X(q) X(q_{capture})^{-1} P^{-1}\f$,
/// where P is the joint's frame and X the product of its rotations and translations in their order, each about or along
/// an axis fixed in the frame left by the ones before. At the capture values every transform is the identity, to the
/// last bit. Joints must stand parents before children, and each body must be the child of one joint at most.
Pose pose_at(const Scene& scene, std::span<const Real> coordinates);

/// A coordinate as people read it: degrees, or millimetres of a translation.
inline Real shown_value(const JointAxis& axis, Real value) { return axis.translation ? 1000 * value : degrees(value); }
/// The unit of shown_value: "deg" or "mm".
inline const char* shown_unit(const JointAxis& axis) { return axis.translation ? "mm" : "deg"; }

}  // namespace gracilis
