#include <gracilis/dynamics/constraints/projection.hpp>

#include <hwy/cache_control.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/dynamics/constraints/projection.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/dynamics/constraints/kernels-inl.hpp>
#include <gracilis/dynamics/simd/particle_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// ∇C·(x - xⁿ) of one particle.
HWY_INLINE V motion_along(Point gradient, Point x, const float* start, const Index* indices) {
  return dot<Math>(gradient, x - load_particles(start, indices).x);
}

/// The ends of the edges in the slots from `at` on, one edge per lane.
struct LoadedEdges {
  const Index *ia, *ib;
  LoadedParticles a, b;

  HWY_INLINE V weight() const { return a.w + b.w; }
};

HWY_INLINE LoadedEdges load_edges(const DistanceSet& set, std::size_t at, const Particles& particles) {
  const Index *ia = set.a.data() + at, *ib = set.b.data() + at;
  return {ia, ib, load_particles(particles.xyzw.data(), ia), load_particles(particles.xyzw.data(), ib)};
}

/// Moves the second end by `share` of `along` times its inverse mass, the first the other way by its own.
HWY_INLINE void move_ends(const LoadedEdges& edges, V share, Point along, Particles& particles) {
  const LoadedParticles &a = edges.a, &b = edges.b;
  store_particles(particles.xyzw.data(), edges.ia, a.x - scaled(a.w * share, along), a.w);
  store_particles(particles.xyzw.data(), edges.ib, b.x + scaled(b.w * share, along), b.w);
}

/// How many of the edges have ends that coincide, so that nothing tells where to, though one could move.
HWY_INLINE Index count_without_direction(const V& length, const V& weight) {
  const D d;
  return static_cast<Index>(hn::CountTrue(d, hn::And(hn::Lt(length, hn::Set(d, 1e-12f)), hn::Gt(weight, hn::Zero(d)))));
}

template <bool dissipative>
ProjectionCounts project_distance_range(const DistanceSet& set, ColorRange range, const float* target_length,
                                        float* lambda, const Particles& start, Particles& particles,
                                        const ProjectionParameters& parameters, StretchWatch* watch) {
  const D d;
  const float inverse_dt2 = 1 / (parameters.time_step * parameters.time_step);
  const V tiny = hn::Set(d, 1e-30f), zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  ProjectionCounts counts;
  for (Index slot = range.begin; slot < range.end; slot += static_cast<Index>(hn::Lanes(d))) {
    const auto at = static_cast<std::size_t>(slot);
    const LoadedEdges edges = load_edges(set, at, particles);
    const EdgeLength<V> edge = edge_length<Math>(edges.a.x, edges.b.x);
    const V c = edge.length - hn::LoadU(d, target_length + at);
    const V alpha = hn::LoadU(d, set.compliance.data() + at) * hn::Set(d, inverse_dt2);
    const V multiplier = hn::LoadU(d, lambda + at);
    const V moving_weight = edges.weight();
    V weight = moving_weight;
    V numerator = c + alpha * multiplier;
    if constexpr (dissipative) {
      const V gamma = alpha * hn::Set(d, parameters.time_step * parameters.rayleigh_beta);
      numerator = numerator + gamma * (motion_along(edge.direction, edges.b.x, start.xyzw.data(), edges.ib) -
                                       motion_along(edge.direction, edges.a.x, start.xyzw.data(), edges.ia));
      weight = weight * (one + gamma);
    }
    // Between two fixed particles, and in padding, nothing moves.
    const V step = hn::IfThenElse(hn::Gt(moving_weight, zero), (zero - numerator) * Math::reciprocal(hn::Max(weight + alpha, tiny)), zero);
    counts.skipped += count_without_direction(edge.length, moving_weight);
    if (watch) {
      const auto is_near = hn::Gt(edge.length, hn::LoadU(d, watch->from.data() + at));
      if (!hn::AllFalse(d, hn::And(is_near, hn::Gt(moving_weight, zero))))
        watch->groups[at / group_width] = 1;
    }
    hn::StoreU(multiplier + step, d, lambda + at);
    move_ends(edges, step, edge.direction, particles);
  }
  return counts;
}

ProjectionCounts project_distances(const DistanceSet& set, ColorRange range, const float* target_length, float* lambda,
                                   const Particles& start, Particles& particles,
                                   const ProjectionParameters& parameters, StretchWatch* watch) {
  return parameters.rayleigh_beta > 0
             ? project_distance_range<true>(set, range, target_length, lambda, start, particles, parameters, watch)
             : project_distance_range<false>(set, range, target_length, lambda, start, particles, parameters, watch);
}

ProjectionCounts project_contractions(const DistanceSet& set, ColorRange range, const float* target_length,
                                      float strength, float* lambda, Particles& particles,
                                      const ProjectionParameters& parameters) {
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
    // A pull has a negative multiplier; a push is none of this constraint's business.
    const V step = hn::IfThenElseZero(hn::Gt(weight, zero), hn::Min(wanted, zero) - multiplier);
    counts.skipped += count_without_direction(edge.length, weight);
    hn::StoreU(multiplier + step, d, lambda + at);
    move_ends(edges, step, edge.direction, particles);
  }
  return counts;
}

Index limit_stretch(const DistanceSet& set, ColorRange range, float limit, Particles& particles,
                    const StretchWatch* watch) {
  const D d;
  const auto is_watched = [watch](std::size_t at) { return !watch || watch->groups[at / group_width]; };
  // Few of many, which no machine foresees.
  for (auto at = static_cast<std::size_t>(range.begin); at < static_cast<std::size_t>(range.end); at += group_width)
    if (is_watched(at)) {
      hwy::Prefetch(set.a.data() + at);
      hwy::Prefetch(set.b.data() + at);
      hwy::Prefetch(set.rest_length.data() + at);
    }
  Index limited = 0;
  for (Index slot = range.begin; slot < range.end; slot += static_cast<Index>(hn::Lanes(d))) {
    const auto at = static_cast<std::size_t>(slot);
    if (!is_watched(at)) continue;
    const LoadedEdges edges = load_edges(set, at, particles);
    const Point along = edges.b.x - edges.a.x;
    const V longest = hn::Set(d, limit) * hn::LoadU(d, set.rest_length.data() + at);
    const V weight = edges.weight(), length2 = dot<Math>(along, along);
    const auto beyond = hn::And(hn::Gt(length2, longest * longest), hn::Gt(weight, hn::Zero(d)));
    if (hn::AllFalse(d, beyond)) continue;
    limited += static_cast<Index>(hn::CountTrue(d, beyond));
    const V length = hn::Sqrt(length2);
    // The share of the edge that each end gives up, per inverse mass; negative, as they come nearer.
    const V share = hn::IfThenElseZero(beyond, (longest - length) / hn::Max(length * weight, hn::Set(d, 1e-30f)));
    move_ends(edges, share, along, particles);
  }
  return limited;
}

/// The difference of two angles, brought into [-π, π].
HWY_INLINE V wrapped(V angle) {
  const D d;
  const V turn = hn::Set(d, 6.28318530717958647692f), half = hn::Set(d, 3.14159265358979323846f);
  angle = hn::IfThenElse(hn::Gt(angle, half), angle - turn, angle);
  return hn::IfThenElse(hn::Lt(angle, hn::Neg(half)), angle + turn, angle);
}

template <bool arccos, bool dissipative>
ProjectionCounts project_hinge_range(const HingeSet& set, ColorRange range, float* lambda, const Particles& start,
                                     Particles& particles, const ProjectionParameters& parameters) {
  const D d;
  const float inverse_dt2 = 1 / (parameters.time_step * parameters.time_step);
  const bool limiting = parameters.hinge_limit > 0;
  const V tiny = hn::Set(d, 1e-30f), zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  ProjectionCounts counts;
  float* xyzw = particles.xyzw.data();
  for (Index slot = range.begin; slot < range.end; slot += static_cast<Index>(hn::Lanes(d))) {
    const auto at = static_cast<std::size_t>(slot);
    const Index* index[4];
    for (std::size_t k = 0; k < 4; ++k) index[k] = set.particles[k].data() + at;
    const LoadedParticles p0 = load_particles(xyzw, index[0]), p1 = load_particles(xyzw, index[1]),
                          p2 = load_particles(xyzw, index[2]), p3 = load_particles(xyzw, index[3]);
    const HingeAngle<V> hinge =
        arccos ? hinge_angle_arccos<Math>(p0.x, p1.x, p2.x, p3.x) : hinge_angle<Math>(p0.x, p1.x, p2.x, p3.x);
    const V rest = hn::LoadU(d, set.rest_angle.data() + at);
    const V c = arccos ? hinge.angle - rest : wrapped(hinge.angle - rest);
    const V alpha = hn::LoadU(d, set.compliance.data() + at) * hn::Set(d, inverse_dt2);
    const V multiplier = hn::LoadU(d, lambda + at);
    const V g0 = dot<Math>(hinge.g0, hinge.g0), g1 = dot<Math>(hinge.g1, hinge.g1), g2 = dot<Math>(hinge.g2, hinge.g2),
            g3 = dot<Math>(hinge.g3, hinge.g3);
    V weight = hn::MulAdd(p0.w, g0, hn::MulAdd(p1.w, g1, hn::MulAdd(p2.w, g2, p3.w * g3)));
    const auto movable = hn::And(hn::Gt(weight, zero), hn::Gt(hinge.valid, zero));
    V numerator = c + alpha * multiplier;
    if constexpr (dissipative) {
      const V gamma = alpha * hn::Set(d, parameters.time_step * parameters.rayleigh_beta);
      const float* from = start.xyzw.data();
      numerator = numerator +
                  gamma * (motion_along(hinge.g0, p0.x, from, index[0]) + motion_along(hinge.g1, p1.x, from, index[1]) +
                           motion_along(hinge.g2, p2.x, from, index[2]) + motion_along(hinge.g3, p3.x, from, index[3]));
      weight = weight * (one + gamma);
    }
    V step = hn::IfThenElse(movable, (zero - numerator) * Math::reciprocal(hn::Max(weight + alpha, tiny)), zero);
    if (limiting) {
      const V reach2 =
          hn::Max(hn::Max(p0.w * p0.w * g0, p1.w * p1.w * g1), hn::Max(p2.w * p2.w * g2, p3.w * p3.w * g3));
      const V motion2 = step * step * reach2;
      const V limit = hn::LoadU(d, set.edge_length.data() + at) * hn::Set(d, parameters.hinge_limit);
      const auto beyond = hn::Gt(motion2, limit * limit);
      counts.limited += static_cast<Index>(hn::CountTrue(d, beyond));
      step = hn::IfThenElse(beyond, step * limit * Math::inverse_sqrt(hn::Max(motion2, tiny)), step);
    }
    const V moving_weight = hn::Max(hn::Max(p0.w, p1.w), hn::Max(p2.w, p3.w));
    counts.skipped +=
        static_cast<Index>(hn::CountTrue(d, hn::And(hn::Gt(moving_weight, zero), hn::Not(hn::Gt(hinge.valid, zero)))));
    hn::StoreU(multiplier + step, d, lambda + at);
    store_particles(xyzw, index[0], p0.x + scaled(p0.w * step, hinge.g0), p0.w);
    store_particles(xyzw, index[1], p1.x + scaled(p1.w * step, hinge.g1), p1.w);
    store_particles(xyzw, index[2], p2.x + scaled(p2.w * step, hinge.g2), p2.w);
    store_particles(xyzw, index[3], p3.x + scaled(p3.w * step, hinge.g3), p3.w);
  }
  return counts;
}

ProjectionCounts project_hinges(const HingeSet& set, ColorRange range, float* lambda, const Particles& start,
                                Particles& particles, const ProjectionParameters& parameters) {
  const bool dissipative = parameters.rayleigh_beta > 0;
  const auto project = parameters.arccos_hinges
                           ? (dissipative ? project_hinge_range<true, true> : project_hinge_range<true, false>)
                           : (dissipative ? project_hinge_range<false, true> : project_hinge_range<false, false>);
  return project(set, range, lambda, start, particles, parameters);
}

const char* instruction_set() { return hwy::TargetName(HWY_TARGET); }

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(project_distances);
HWY_EXPORT(project_contractions);
HWY_EXPORT(limit_stretch);
HWY_EXPORT(project_hinges);
HWY_EXPORT(instruction_set);

ProjectionCounts project_distances(const DistanceSet& set, ColorRange range, const float* target_length, float* lambda,
                                   const Particles& start, Particles& particles,
                                   const ProjectionParameters& parameters, StretchWatch* watch) {
  return HWY_DYNAMIC_DISPATCH(project_distances)(set, range, target_length, lambda, start, particles, parameters, watch);
}

ProjectionCounts project_contractions(const DistanceSet& set, ColorRange range, const float* target_length,
                                      float strength, float* lambda, Particles& particles,
                                      const ProjectionParameters& parameters) {
  return HWY_DYNAMIC_DISPATCH(project_contractions)(set, range, target_length, strength, lambda, particles, parameters);
}

Index limit_stretch(const DistanceSet& set, ColorRange range, float limit, Particles& particles,
                    const StretchWatch* watch) {
  return HWY_DYNAMIC_DISPATCH(limit_stretch)(set, range, limit, particles, watch);
}

ProjectionCounts project_hinges(const HingeSet& set, ColorRange range, float* lambda, const Particles& start,
                                Particles& particles, const ProjectionParameters& parameters) {
  return HWY_DYNAMIC_DISPATCH(project_hinges)(set, range, lambda, start, particles, parameters);
}

const char* instruction_set() { return HWY_DYNAMIC_DISPATCH(instruction_set)(); }

}  // namespace gracilis
#endif
