#pragma once

#include <gracilis/methods/method_entry.hpp>
#include <gracilis/scene/scene.hpp>

#include <memory>

namespace gracilis {

/// The method `cylinder`.
MethodEntry cylinder_entry();

/// Muscles as sections across their action lines (Laclé 2014), or, where they came as surfaces without one, across the
/// line through their middle (surface_sections.hpp): no solver, a few thousand frames of a muscle per second.
/// The line's points move with their bodies. Sections keep their place along it: in the tendon, which keeps its length,
/// their distance from the insertion, elsewhere their share of the rest; each keeps its shape, and grows as its
/// neighbors come closer, so that the muscle keeps its volume (the published model keeps the radii). Nothing but the
/// present pose counts. Bones are not looked at. Precondition: the scene is valid and its method is `cylinder`.
std::unique_ptr<DeformationMethod> make_cylinder_method(const Scene& scene);

}  // namespace gracilis
