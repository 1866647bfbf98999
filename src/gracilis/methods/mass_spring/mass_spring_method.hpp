#pragma once

#include <gracilis/methods/method_entry.hpp>

#include <memory>
#include <vector>

namespace gracilis {

/// The method `mass-spring` (Janák 2012), with the preset `janak-2012`.
MethodEntry mass_spring_entry();

/// Muscles as particles along their fibers that springs join: bodies carry the particles, springs move them together
/// until an iteration count, a mean motion or a time is reached, spheres and the bones' distance fields keep them
/// apart, and surfaces follow them. Muscles without origin and insertion have no particles: a blend of the bodies'
/// motions moves them. `fields` are those of the scene's bones; none where no muscle asks them. Precondition: the scene
/// is valid.
std::unique_ptr<DeformationMethod> make_mass_spring_method(const Scene& scene, std::vector<DistanceField> fields);

}  // namespace gracilis
