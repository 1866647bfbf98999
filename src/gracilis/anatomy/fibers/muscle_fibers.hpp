#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// The fibers of a muscle in the capture pose, from origin to insertion: fascicles from aponeurosis to
/// aponeurosis, where these or measured tracts are known (see fascicles.hpp); else `attached_fibers_of`. Empty when the
/// muscle wants none.
Polylines fibers_of(const Muscle& muscle);

/// Fibers that run all the way between a muscle's attachments: those given with the scene, resampled and
/// turned so that they begin at the origin; or, where they are superficial ones, those that fill the muscle between
/// them; or, where none are given, those of the template. Empty when the muscle wants none.
Polylines attached_fibers_of(const Muscle& muscle);

/// What one fiber says about a muscle.
struct FiberMeasures {
  std::vector<Real> lengths;              ///< m
  std::vector<Real> origin_pennation;     ///< rad, at the origin: angle between the fiber's end and the line of action
  std::vector<Real> insertion_pennation;  ///< rad, at the insertion
};

/// Lengths and pennation angles. A fiber's direction at an end is that of the first tenth of its length. The line of
/// action at an end is the mean of all fibers' directions there.
FiberMeasures measure_fibers(const Polylines& fibers);

/// The mean length, m; 0 without fibers.
Real mean_fiber_length(const Polylines& fibers);

/// Physiological cross-section area, m²: \f$V / \bar l\f$, l̄ the mean length (Lieber and Fridén 2000, no pennation);
/// 0 without fibers.
Real physiological_cross_section(Real volume, const Polylines& fibers);

}  // namespace gracilis
