#pragma once

#include <gracilis/scene/scene.hpp>

#include <optional>

namespace gracilis {

/// The pennation (rad, between 5 and 45 degrees) at which fibers between the belly's two broad sides are `length` (m)
/// long on average, to a degree. Nothing where none is: they are longer or shorter at any of these angles, or
/// attachments are spread like aponeuroses, which tell more. Precondition: there is an origin and an insertion.
std::optional<Real> fitted_pennation(Muscle muscle, Real length);

}  // namespace gracilis
