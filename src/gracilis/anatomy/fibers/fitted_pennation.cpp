#include <gracilis/anatomy/fibers/fitted_pennation.hpp>

#include <gracilis/anatomy/fibers/aponeurosis_guides.hpp>
#include <gracilis/anatomy/fibers/fascicles.hpp>

namespace gracilis {

static constexpr int sampled_fibers = 40;  ///< whose mean tells to a few percent
static constexpr Real least_pennation = radians(5), most_pennation = radians(45), told_to = radians(1);

static Real mean_fiber_length(Muscle& muscle, Real pennation) {
  muscle.fibers.pennation = pennation;
  const Polylines fibers = fascicles_of(muscle);
  Real sum = 0;
  for (const Real length : polyline_lengths(fibers)) sum += length;
  return fibers.count() > 0 ? sum / static_cast<Real>(fibers.count()) : 0;
}

std::optional<Real> fitted_pennation(Muscle muscle, Real length) {
  if (!muscle.aponeuroses.empty() || attachments_are_spread(muscle)) return std::nullopt;
  muscle.fibers.ends = FiberEnds::aponeuroses;
  muscle.fibers.count = sampled_fibers;
  Real low = least_pennation, high = most_pennation;
  if (mean_fiber_length(muscle, low) < length || mean_fiber_length(muscle, high) > length) return std::nullopt;
  while (high - low > told_to) {
    const Real middle = (low + high) / 2;
    (mean_fiber_length(muscle, middle) > length ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace gracilis
