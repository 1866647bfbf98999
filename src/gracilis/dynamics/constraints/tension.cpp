#include <gracilis/dynamics/constraints/tension.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/dynamics/constraints/tension.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/dynamics/constraints/distance-inl.hpp>
#include <gracilis/dynamics/constraints/edge_ends-inl.hpp>
#include <gracilis/dynamics/constraints/multiplier-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

template <bool dissipative>
ProjectionCounts project_tension_range(const DistanceSet& set, ColorRange range, const float* target_length,
                                       const TensionLaw& law, float* lambda, const Particles& start,
                                       Particles& particles, const ProjectionParameters& parameters) {
  const D d;
  const V zero = hn::Zero(d), tiny = hn::Set(d, 1e-30f),
          softness = hn::Set(d, 1 / (law.strength * parameters.time_step * parameters.time_step));
  ProjectionCounts counts;
  for (Index slot = range.begin; slot < range.end; slot += static_cast<Index>(hn::Lanes(d))) {
    const auto at = static_cast<std::size_t>(slot);
    const LoadedEdges edges = load_edges(set, at, particles);
    const EdgeLength<V> edge = edge_length<Math>(edges.a.x, edges.b.x);
    const V c = edge.length - hn::LoadU(d, target_length + at), weight = edges.weight();
    const V alpha = hn::LoadU(d, set.compliance.data() + at) * softness;
    const V multiplier = hn::LoadU(d, lambda + at);
    V numerator = c + alpha * multiplier, damped_weight = weight;
    if constexpr (dissipative)
      add_dissipation(alpha, motion_of(edges, edge.direction, start), parameters, numerator, damped_weight);
    const V wanted = multiplier - numerator * Math::reciprocal(hn::Max(damped_weight + alpha, tiny));
    // A pull has a negative multiplier; one that is not is no pull.
    const V allowed = law.two_sided ? wanted : hn::Min(wanted, zero);
    const V step = hn::IfThenElseZero(hn::Gt(weight, zero), allowed - multiplier);
    counts.skipped += count_without_direction(edge.length, weight);
    hn::StoreU(multiplier + step, d, lambda + at);
    move_ends(edges, step, edge.direction, particles);
  }
  return counts;
}

ProjectionCounts project_tensions(const DistanceSet& set, ColorRange range, const float* target_length,
                                  const TensionLaw& law, float* lambda, const Particles& start, Particles& particles,
                                  const ProjectionParameters& parameters) {
  if (!(parameters.rayleigh_beta > 0))
    return project_tension_range<false>(set, range, target_length, law, lambda, start, particles, parameters);
  ProjectionParameters active = parameters;
  active.rayleigh_beta *= law.strength;
  return project_tension_range<true>(set, range, target_length, law, lambda, start, particles, active);
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(project_tensions);

ProjectionCounts project_tensions(const DistanceSet& set, ColorRange range, const float* target_length,
                                  const TensionLaw& law, float* lambda, const Particles& start, Particles& particles,
                                  const ProjectionParameters& parameters) {
  return HWY_DYNAMIC_DISPATCH(project_tensions)(set, range, target_length, law, lambda, start, particles, parameters);
}

}  // namespace gracilis
#endif
