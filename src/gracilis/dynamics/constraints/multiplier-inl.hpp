// How far a projection moves the multipliers of constraints (projection_parameters.hpp), one constraint per lane.
// Included once per instruction set.

#if defined(GRACILIS_MULTIPLIER_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_MULTIPLIER_INL
#undef GRACILIS_MULTIPLIER_INL
#else
#define GRACILIS_MULTIPLIER_INL
#endif

#include <gracilis/dynamics/constraints/projection_parameters.hpp>
#include <gracilis/dynamics/simd/particle_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// ∇C·(x - xⁿ) of one particle.
HWY_INLINE V motion_along(Point gradient, Point x, const float* start, const Index* indices) {
  return dot<Math>(gradient, x - load_particles(start, indices).x);
}

/// Adds Rayleigh's dissipation to the numerator and the weight of Δλ; `motion` is ∇C·(x - xⁿ).
HWY_INLINE void add_dissipation(V alpha, V motion, const ProjectionParameters& parameters, V& numerator, V& weight) {
  const D d;
  const V gamma = alpha * hn::Set(d, parameters.time_step * parameters.rayleigh_beta);
  numerator = numerator + gamma * motion;
  weight = weight * (hn::Set(d, 1.0f) + gamma);
}

/// Δλ of constraints of value `c` whose gradients have the inverse mass `weight` = ∇C w ∇Cᵀ; 0 where they are not
/// `movable`. `motion` is ∇C·(x - xⁿ), of no use without dissipation.
template <bool dissipative>
HWY_INLINE V multiplier_step(V c, V alpha, V multiplier, V weight, hn::Mask<D> movable,
                             const ProjectionParameters& parameters, V motion) {
  const D d;
  const V tiny = hn::Set(d, 1e-30f), zero = hn::Zero(d);
  V numerator = c + alpha * multiplier;
  if constexpr (dissipative) add_dissipation(alpha, motion, parameters, numerator, weight);
  return hn::IfThenElse(movable, (zero - numerator) * Math::reciprocal(hn::Max(weight + alpha, tiny)), zero);
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
