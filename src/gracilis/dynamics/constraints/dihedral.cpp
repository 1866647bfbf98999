#include <gracilis/dynamics/constraints/dihedral.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/dynamics/constraints/dihedral.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/dynamics/constraints/dihedral-inl.hpp>
#include <gracilis/dynamics/constraints/multiplier-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// The difference of two angles, brought into [-π, π].
HWY_INLINE V wrapped(V angle) {
  const D d;
  const V turn = hn::Set(d, 6.28318530717958647692f), half = hn::Set(d, 3.14159265358979323846f);
  angle = hn::IfThenElse(hn::Gt(angle, half), angle - turn, angle);
  return hn::IfThenElse(hn::Lt(angle, hn::Neg(half)), angle + turn, angle);
}

template <bool arccos, bool dissipative>
ProjectionCounts project_dihedral_range(const DihedralSet& set, ColorRange range, float* lambda, const Particles& start,
                                        Particles& particles, const ProjectionParameters& parameters) {
  const D d;
  const float inverse_dt2 = 1 / (parameters.time_step * parameters.time_step);
  const bool limiting = parameters.dihedral_limit > 0;
  const V tiny = hn::Set(d, 1e-30f), zero = hn::Zero(d);
  ProjectionCounts counts;
  float* xyzw = particles.xyzw.data();
  for (Index slot = range.begin; slot < range.end; slot += static_cast<Index>(hn::Lanes(d))) {
    const auto at = static_cast<std::size_t>(slot);
    const Index* index[4];
    for (std::size_t k = 0; k < 4; ++k) index[k] = set.particles[k].data() + at;
    const LoadedParticles p0 = load_particles(xyzw, index[0]), p1 = load_particles(xyzw, index[1]),
                          p2 = load_particles(xyzw, index[2]), p3 = load_particles(xyzw, index[3]);
    const DihedralAngle<V> dihedral =
        arccos ? dihedral_angle_arccos<Math>(p0.x, p1.x, p2.x, p3.x) : dihedral_angle<Math>(p0.x, p1.x, p2.x, p3.x);
    const V rest = hn::LoadU(d, set.rest_angle.data() + at);
    const V c = arccos ? dihedral.angle - rest : wrapped(dihedral.angle - rest);
    const V alpha = hn::LoadU(d, set.compliance.data() + at) * hn::Set(d, inverse_dt2);
    const V multiplier = hn::LoadU(d, lambda + at);
    const V g0 = dot<Math>(dihedral.g0, dihedral.g0), g1 = dot<Math>(dihedral.g1, dihedral.g1),
            g2 = dot<Math>(dihedral.g2, dihedral.g2), g3 = dot<Math>(dihedral.g3, dihedral.g3);
    const V weight = hn::MulAdd(p0.w, g0, hn::MulAdd(p1.w, g1, hn::MulAdd(p2.w, g2, p3.w * g3)));
    const auto movable = hn::And(hn::Gt(weight, zero), hn::Gt(dihedral.valid, zero));
    V motion = zero;
    if constexpr (dissipative) {
      const float* from = start.xyzw.data();
      motion = motion_along(dihedral.g0, p0.x, from, index[0]) + motion_along(dihedral.g1, p1.x, from, index[1]) +
               motion_along(dihedral.g2, p2.x, from, index[2]) + motion_along(dihedral.g3, p3.x, from, index[3]);
    }
    V step = multiplier_step<dissipative>(c, alpha, multiplier, weight, movable, parameters, motion);
    if (limiting) {
      const V reach2 =
          hn::Max(hn::Max(p0.w * p0.w * g0, p1.w * p1.w * g1), hn::Max(p2.w * p2.w * g2, p3.w * p3.w * g3));
      const V motion2 = step * step * reach2;
      const V limit = hn::LoadU(d, set.edge_length.data() + at) * hn::Set(d, parameters.dihedral_limit);
      const auto beyond = hn::Gt(motion2, limit * limit);
      counts.limited += static_cast<Index>(hn::CountTrue(d, beyond));
      step = hn::IfThenElse(beyond, step * limit * Math::inverse_sqrt(hn::Max(motion2, tiny)), step);
    }
    const V moving_weight = hn::Max(hn::Max(p0.w, p1.w), hn::Max(p2.w, p3.w));
    counts.skipped += static_cast<Index>(
        hn::CountTrue(d, hn::And(hn::Gt(moving_weight, zero), hn::Not(hn::Gt(dihedral.valid, zero)))));
    hn::StoreU(multiplier + step, d, lambda + at);
    store_particles(xyzw, index[0], p0.x + scaled(p0.w * step, dihedral.g0), p0.w);
    store_particles(xyzw, index[1], p1.x + scaled(p1.w * step, dihedral.g1), p1.w);
    store_particles(xyzw, index[2], p2.x + scaled(p2.w * step, dihedral.g2), p2.w);
    store_particles(xyzw, index[3], p3.x + scaled(p3.w * step, dihedral.g3), p3.w);
  }
  return counts;
}

ProjectionCounts project_dihedrals(const DihedralSet& set, ColorRange range, float* lambda, const Particles& start,
                                   Particles& particles, const ProjectionParameters& parameters) {
  const bool dissipative = parameters.rayleigh_beta > 0;
  const auto project = parameters.arccos_dihedrals
                           ? (dissipative ? project_dihedral_range<true, true> : project_dihedral_range<true, false>)
                           : (dissipative ? project_dihedral_range<false, true> : project_dihedral_range<false, false>);
  return project(set, range, lambda, start, particles, parameters);
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(project_dihedrals);

DihedralSet build_dihedral_set(const std::vector<DihedralConstraint>& constraints, Index particle_count) {
  ConstraintGraph graph{4, particle_count, {}};
  for (const DihedralConstraint& c : constraints)
    graph.particles.insert(graph.particles.end(), c.particles.begin(), c.particles.end());
  ConstraintLayout layout = lay_out(graph);
  DihedralSet set;
  const std::size_t size = layout.idle.size();
  set.particles.fill(layout.idle);
  set.rest_angle.assign(size, 0);
  set.compliance.assign(size, 0);
  set.edge_length.assign(size, 0);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const auto at = static_cast<std::size_t>(layout.slot[i]);
    for (std::size_t k = 0; k < 4; ++k) set.particles[k][at] = constraints[i].particles[k];
    set.rest_angle[at] = static_cast<float>(constraints[i].rest_angle);
    set.compliance[at] = static_cast<float>(constraints[i].compliance);
    set.edge_length[at] = static_cast<float>(constraints[i].edge_length);
  }
  set.order = std::move(layout.order);
  set.count = static_cast<Index>(constraints.size());
  return set;
}

ProjectionCounts project_dihedrals(const DihedralSet& set, ColorRange range, float* lambda, const Particles& start,
                                   Particles& particles, const ProjectionParameters& parameters) {
  return HWY_DYNAMIC_DISPATCH(project_dihedrals)(set, range, lambda, start, particles, parameters);
}

}  // namespace gracilis
#endif
