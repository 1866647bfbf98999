#include <gracilis/dynamics/constraints/distance.hpp>

#include <gracilis/dynamics/constraints/strain_limit.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/dynamics/constraints/distance.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/dynamics/constraints/distance-inl.hpp>
#include <gracilis/dynamics/constraints/edge_ends-inl.hpp>
#include <gracilis/dynamics/constraints/multiplier-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

template <bool dissipative>
ProjectionCounts project_distance_range(const DistanceSet& set, ColorRange range, const float* target_length,
                                        float* lambda, const Particles& start, Particles& particles,
                                        const ProjectionParameters& parameters, StrainLimitActiveSet* limited) {
  const D d;
  const float inverse_dt2 = 1 / (parameters.time_step * parameters.time_step);
  const V zero = hn::Zero(d);
  ProjectionCounts counts;
  for (Index slot = range.begin; slot < range.end; slot += static_cast<Index>(hn::Lanes(d))) {
    const auto at = static_cast<std::size_t>(slot);
    const LoadedEdges edges = load_edges(set, at, particles);
    const EdgeLength<V> edge = edge_length<Math>(edges.a.x, edges.b.x);
    const V c = edge.length - hn::LoadU(d, target_length + at);
    const V alpha = hn::LoadU(d, set.compliance.data() + at) * hn::Set(d, inverse_dt2);
    const V multiplier = hn::LoadU(d, lambda + at);
    const V moving_weight = edges.weight();
    V motion = zero;
    if constexpr (dissipative) motion = motion_of(edges, edge.direction, start);
    // Between two fixed particles, and in padding, nothing moves.
    const V step = multiplier_step<dissipative>(c, alpha, multiplier, moving_weight, hn::Gt(moving_weight, zero),
                                                parameters, motion);
    counts.skipped += count_without_direction(edge.length, moving_weight);
    if (limited) {
      const auto is_near = hn::Gt(edge.length, hn::LoadU(d, limited->from.data() + at));
      if (!hn::AllFalse(d, hn::And(is_near, hn::Gt(moving_weight, zero)))) limited->groups[at / group_width] = 1;
    }
    hn::StoreU(multiplier + step, d, lambda + at);
    move_ends(edges, step, edge.direction, particles);
  }
  return counts;
}

ProjectionCounts project_distances(const DistanceSet& set, ColorRange range, const float* target_length, float* lambda,
                                   const Particles& start, Particles& particles, const ProjectionParameters& parameters,
                                   StrainLimitActiveSet* limited) {
  return parameters.rayleigh_beta > 0
             ? project_distance_range<true>(set, range, target_length, lambda, start, particles, parameters, limited)
             : project_distance_range<false>(set, range, target_length, lambda, start, particles, parameters, limited);
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(project_distances);

DistanceSet build_distance_set(const std::vector<DistanceConstraint>& constraints, Index particle_count) {
  ConstraintGraph graph{2, particle_count, {}};
  for (const DistanceConstraint& c : constraints) graph.particles.insert(graph.particles.end(), {c.a, c.b});
  ConstraintLayout layout = lay_out(graph);
  DistanceSet set;
  const std::size_t size = layout.idle.size();
  set.a = set.b = layout.idle;
  set.rest_length.assign(size, 0);
  set.compliance.assign(size, 0);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const auto at = static_cast<std::size_t>(layout.slot[i]);
    set.a[at] = constraints[i].a;
    set.b[at] = constraints[i].b;
    set.rest_length[at] = static_cast<float>(constraints[i].rest_length);
    set.compliance[at] = static_cast<float>(constraints[i].compliance);
  }
  set.order = std::move(layout.order);
  set.slot = std::move(layout.slot);
  set.count = static_cast<Index>(constraints.size());
  return set;
}

ProjectionCounts project_distances(const DistanceSet& set, ColorRange range, const float* target_length, float* lambda,
                                   const Particles& start, Particles& particles, const ProjectionParameters& parameters,
                                   StrainLimitActiveSet* limited) {
  return HWY_DYNAMIC_DISPATCH(project_distances)(set, range, target_length, lambda, start, particles, parameters,
                                                 limited);
}

}  // namespace gracilis
#endif
