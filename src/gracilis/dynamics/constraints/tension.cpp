#include <gracilis/dynamics/constraints/tension.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/dynamics/constraints/tension.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/dynamics/constraints/distance-inl.hpp>
#include <gracilis/dynamics/constraints/edge_ends-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

ProjectionCounts project_tensions(const DistanceSet& set, ColorRange range, const float* target_length, float strength,
                                  float* lambda, Particles& particles, const ProjectionParameters& parameters) {
  const D d;
  const V zero = hn::Zero(d), tiny = hn::Set(d, 1e-30f),
          softness = hn::Set(d, 1 / (strength * parameters.time_step * parameters.time_step));
  ProjectionCounts counts;
  for (Index slot = range.begin; slot < range.end; slot += static_cast<Index>(hn::Lanes(d))) {
    const auto at = static_cast<std::size_t>(slot);
    const LoadedEdges edges = load_edges(set, at, particles);
    const EdgeLength<V> edge = edge_length<Math>(edges.a.x, edges.b.x);
    const V c = edge.length - hn::LoadU(d, target_length + at), weight = edges.weight();
    const V alpha = hn::LoadU(d, set.compliance.data() + at) * softness;
    const V multiplier = hn::LoadU(d, lambda + at);
    const V wanted = multiplier - (c + alpha * multiplier) * Math::reciprocal(hn::Max(weight + alpha, tiny));
    // A pull has a negative multiplier; one that is not is no pull.
    const V step = hn::IfThenElseZero(hn::Gt(weight, zero), hn::Min(wanted, zero) - multiplier);
    counts.skipped += count_without_direction(edge.length, weight);
    hn::StoreU(multiplier + step, d, lambda + at);
    move_ends(edges, step, edge.direction, particles);
  }
  return counts;
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(project_tensions);

ProjectionCounts project_tensions(const DistanceSet& set, ColorRange range, const float* target_length, float strength,
                                  float* lambda, Particles& particles, const ProjectionParameters& parameters) {
  return HWY_DYNAMIC_DISPATCH(project_tensions)(set, range, target_length, strength, lambda, particles, parameters);
}

}  // namespace gracilis
#endif
