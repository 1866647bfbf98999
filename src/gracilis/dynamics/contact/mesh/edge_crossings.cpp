#include <gracilis/dynamics/contact/mesh/edge_crossings.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/dynamics/contact/mesh/edge_crossings.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/dynamics/simd/particle_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// What rounding may have changed, as a share.
constexpr float rounding = 1e-4f;

HWY_INLINE Point all_lanes(const Eigen::Vector3f& v) {
  const D d;
  return {hn::Set(d, v.x()), hn::Set(d, v.y()), hn::Set(d, v.z())};
}

/// Whether lines from `start` along `along`, one per lane, pass the edge so closely, by where they are nearest.
HWY_INLINE hn::Mask<D> crossing(const Segment& edge, float within, const Point& start, const Point& along) {
  const D d;
  const Point own = all_lanes(edge.to - edge.from), between = all_lanes(edge.from) - start, across = cross(own, along);
  const V across2 = dot<Math>(across, across), apart = dot<Math>(across, between);
  const V low = hn::Set(d, -rounding) * across2, high = hn::Set(d, 1 + rounding) * across2;
  const V s = dot<Math>(cross(along, between), across), t = dot<Math>(cross(own, between), across);
  const auto is_between = [&](const V& share) HWY_ATTR { return hn::And(hn::Ge(share, low), hn::Le(share, high)); };
  const hn::Mask<D> is_close = hn::Lt(apart * apart, hn::Set(d, within * within * (1 + rounding)) * across2);
  return hn::And(is_close, hn::And(is_between(s), is_between(t)));
}

void keep_crossing(const Segment& edge, float within, const ContactSurface& surface, const Particles& particles,
                   std::vector<Index>& candidates) {
  constexpr std::size_t lanes = hn::MaxLanes(D());
  std::size_t kept = 0;
  for (std::size_t at = 0; at < candidates.size(); at += lanes) {
    Index from[lanes], to[lanes];
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      from[lane] = to[lane] = particles.count();  // the idle one, which crosses nothing
      if (at + lane >= candidates.size()) continue;
      const auto& ends = surface.edges[static_cast<std::size_t>(candidates[at + lane])].ends;
      from[lane] = ends[0], to[lane] = ends[1];
    }
    const Point start = load_particles(particles.xyzw.data(), from).x;
    const Point along = load_particles(particles.xyzw.data(), to).x - start;
    const hn::Mask<D> crosses = crossing(edge, within, start, along);
    for_each_lane(crosses, [&](std::size_t lane) { candidates[kept++] = candidates[at + lane]; });
  }
  candidates.resize(kept);
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(keep_crossing);

void keep_crossing(const Segment& edge, float within, const ContactSurface& surface, const Particles& particles,
                   std::vector<Index>& candidates) {
  HWY_DYNAMIC_DISPATCH(keep_crossing)(edge, within, surface, particles, candidates);
}

}  // namespace gracilis
#endif
