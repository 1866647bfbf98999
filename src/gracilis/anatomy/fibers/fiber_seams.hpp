#pragma once

#include <gracilis/anatomy/fibers/fiber_field.hpp>

#include <optional>
#include <vector>

namespace gracilis {

/// Where fibers of two sides meet at an angle: an aponeurosis in the muscle that nobody gave, as in bipennate ones. A
/// smooth field leads along it instead of ending there.
struct FiberSeam {
  Vec3 place;   ///< on the seam
  Vec3 across;  ///< unit, the way on to the other side
  Vec3 before;  ///< unit, the way of fibers that come to it on this side
};

/// The seam that the way along the field (against it where `sign` is -1) is running into at a place: `reach` (m) across
/// it on either side the ways lead towards it and differ by more than 15 degrees, while they do not along it, and half
/// of that turn is made.
std::optional<FiberSeam> seam_at(const FiberField& field, const Vec3& place, Real sign, Real reach);

/// A way that runs into a seam, taken straight there from where the turn began, `reach` before it.
void end_at_seam(const FiberSeam& seam, Real reach, std::vector<Vec3>& way);

}  // namespace gracilis
