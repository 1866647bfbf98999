#include <gracilis/dynamics/contact/field/field_contact_edges.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/dynamics/contact/field/field_contact_edges.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/dynamics/contact/field/field_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// How the deepest point of an edge is followed: the step is the slope along the edge times this, at most a quarter of
/// a cell.
constexpr float follow_radius = 0.004f;

/// The edges in one group of slots, one per lane.
struct LoadedNearEdges {
  const Index *ia, *ib;
  LoadedParticles a, b;
  Point along;
  V gap, rise;  ///< at a, and from there to b
  V low, high;  ///< the part that is tested
};

HWY_INLINE LoadedNearEdges load_near_edges(const NearEdges& edges, std::size_t at, const Particles& particles) {
  const D d;
  LoadedNearEdges loaded;
  loaded.ia = edges.a.data() + at, loaded.ib = edges.b.data() + at;
  loaded.a = load_particles(particles.xyzw.data(), loaded.ia);
  loaded.b = load_particles(particles.xyzw.data(), loaded.ib);
  loaded.along = loaded.b.x - loaded.a.x;
  loaded.gap = hn::LoadU(d, edges.gap_a.data() + at);
  loaded.rise = hn::LoadU(d, edges.gap_b.data() + at) - loaded.gap;
  loaded.low = hn::LoadU(d, edges.low.data() + at);
  loaded.high = hn::LoadU(d, edges.high.data() + at);
  return loaded;
}

HWY_INLINE Point point_at(const LoadedNearEdges& edges, const V& t, const FieldPlacement& placement) {
  return to_obstacle(placement, edges.a.x + scaled(t, edges.along));
}

/// Where the edges in `asked` are deepest below the lines between their gaps: bisection by the slope along the edge,
/// four samples. A local minimum where the obstacle is not convex.
HWY_INLINE V deepest_points(const LoadedNearEdges& edges, Mask asked, const FieldGrid& grid,
                            const FieldPlacement& placement) {
  const D d;
  V low = edges.low, high = edges.high, best = number(0.5f) * (low + high), deepest = hn::Inf(d);
  for (int step = 0; step < 4; ++step) {
    const V t = number(0.5f) * (low + high);
    const SampledField at = sample(grid, point_at(edges, t, placement), asked);
    const V height = at.distance - hn::MulAdd(t, edges.rise, edges.gap);
    best = hn::IfThenElse(hn::Lt(height, deepest), t, best);
    deepest = hn::Min(deepest, height);
    const Mask climbs = hn::Gt(dot<Math>(turned_back(placement, at.gradient), edges.along), edges.rise);
    high = hn::IfThenElse(climbs, t, high);
    low = hn::IfThenElse(climbs, low, t);
  }
  return best;
}

void find_deepest_points(const FieldGrid& grid, const FieldPlacement& placement, const Particles& particles,
                         NearEdges& edges) {
  const D d;
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  for (Index slot = 0; slot < edges.count(); slot += lanes) {
    const auto at = static_cast<std::size_t>(slot);
    const LoadedNearEdges loaded = load_near_edges(edges, at, particles);
    const Mask asked = hn::Le(hn::LoadU(d, edges.seen_above.data() + at), number(edge_reserve));
    if (hn::AllFalse(d, asked)) continue;
    const V t = hn::IfThenElse(asked, deepest_points(loaded, asked, grid, placement), number(unknown_point));
    hn::StoreU(t, d, edges.t.data() + at);
  }
}

/// Whether what was seen so far above its gap may have come down to the reserve on its way to q.
HWY_INLINE Mask may_have_come_down(const NearEdges& edges, std::size_t at, const Point& q) {
  const D d;
  const Point moved = {q.x - hn::LoadU(d, edges.seen_x.data() + at), q.y - hn::LoadU(d, edges.seen_y.data() + at),
                       q.z - hn::LoadU(d, edges.seen_z.data() + at)};
  const V left = hn::LoadU(d, edges.seen_above.data() + at) - number(edge_reserve);
  return hn::Or(hn::Le(left, hn::Zero(d)), hn::Ge(number(steepest * steepest) * dot<Math>(moved, moved), left * left));
}

HWY_INLINE void remember_seen(NearEdges& edges, std::size_t at, Mask seen, const Point& q, const V& above) {
  const D d;
  const auto store = [&](const V& value, AlignedVector<float>& values)
                         HWY_ATTR { hn::BlendedStore(value, seen, d, values.data() + at); };
  store(q.x, edges.seen_x), store(q.y, edges.seen_y), store(q.z, edges.seen_z), store(above, edges.seen_above);
}

/// A step of each point along its edge towards where it is deeper.
HWY_INLINE V followed(const LoadedNearEdges& edges, const V& t, const Point& gradient, float longest_step) {
  const V length2 = hn::Max(dot<Math>(edges.along, edges.along), number(1e-30f)), inverse = Math::inverse_sqrt(length2);
  const V slope = (dot<Math>(gradient, edges.along) - edges.rise) * inverse;
  const V step = hn::Min(hn::Max(number(follow_radius) * slope, number(-longest_step)), number(longest_step)) * inverse;
  return hn::Min(hn::Max(t - step, edges.low), edges.high);
}

Index project_near_edges(const FieldGrid& grid, const FieldPlacement& placement, float longest_step, ColorRange range,
                         NearEdges& edges, Particles& particles) {
  const D d;
  const V zero = hn::Zero(d), one = number(1);
  Index touching = 0;
  for (Index slot = range.begin; slot < range.end; slot += static_cast<Index>(hn::Lanes(d))) {
    const auto at = static_cast<std::size_t>(slot);
    const LoadedNearEdges loaded = load_near_edges(edges, at, particles);
    const V last = hn::LoadU(d, edges.t.data() + at);
    const Mask known = hn::Ge(last, zero);
    V t = hn::IfThenElse(known, last, number(0.5f));
    Point q = point_at(loaded, t, placement);
    const Mask near = hn::And(may_have_come_down(edges, at, q), hn::Gt(loaded.a.w + loaded.b.w, zero));
    if (hn::AllFalse(d, near)) continue;
    const Mask found = hn::AndNot(known, near);
    if (!hn::AllFalse(d, found)) {
      t = hn::IfThenElse(found, deepest_points(loaded, found, grid, placement), t);
      q = point_at(loaded, t, placement);
    }
    const SampledField field = sample(grid, q, near);
    const V slope2 = dot<Math>(field.gradient, field.gradient);
    const Mask seen = hn::Ge(slope2, number(least_slope2));
    const Point gradient = turned_back(placement, field.gradient);
    const V depth = hn::IfThenElseZero(seen, hn::MulAdd(t, loaded.rise, loaded.gap) - field.distance);
    remember_seen(edges, at, seen, q, zero - depth);
    hn::BlendedStore(hn::IfThenElse(seen, followed(loaded, t, gradient, longest_step), t), near, d,
                     edges.t.data() + at);
    const Mask pushed = hn::Gt(depth, zero);
    if (hn::AllFalse(d, pushed)) continue;
    touching += static_cast<Index>(hn::CountTrue(d, pushed));
    const V share_a = loaded.a.w * (one - t), share_b = loaded.b.w * t;
    const V weight = hn::MulAdd(share_a, one - t, share_b * t);
    const V push = hn::IfThenElseZero(pushed, depth / hn::Max(slope2 * weight, number(1e-30f)));
    store_particles(particles.xyzw.data(), loaded.ia, loaded.a.x + scaled(share_a * push, gradient), loaded.a.w);
    store_particles(particles.xyzw.data(), loaded.ib, loaded.b.x + scaled(share_b * push, gradient), loaded.b.w);
  }
  return touching;
}

void gather_low_edges(const DistanceSet& distances, ColorRange color, const std::vector<float>& clearance, float reach,
                      float per_length, std::vector<Index>& slots) {
  const D d;
  const hn::RebindToSigned<D> di;
  constexpr float beyond_rounding = 1.00001f;
  const V most = number(beyond_rounding * reach), factor = number(beyond_rounding * per_length);
  for (Index slot = color.begin; slot < color.end; slot += static_cast<Index>(hn::Lanes(d))) {
    const auto at = static_cast<std::size_t>(slot);
    const V at_a = hn::GatherIndex(d, clearance.data(), hn::LoadU(di, distances.a.data() + at)),
            at_b = hn::GatherIndex(d, clearance.data(), hn::LoadU(di, distances.b.data() + at));
    const V length = hn::LoadU(d, distances.rest_length.data() + at);
    for_each_lane(hn::Le(at_a + at_b, hn::MulAdd(factor, length, most)),
                  [&](std::size_t lane) { slots.push_back(slot + static_cast<Index>(lane)); });
  }
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(find_deepest_points);
HWY_EXPORT(project_near_edges);
HWY_EXPORT(gather_low_edges);

void find_deepest_points(const FieldGrid& grid, const FieldPlacement& placement, const Particles& particles,
                         NearEdges& edges) {
  HWY_DYNAMIC_DISPATCH(find_deepest_points)(grid, placement, particles, edges);
}

Index project_near_edges(const FieldGrid& grid, const FieldPlacement& placement, float longest_step, ColorRange range,
                         NearEdges& edges, Particles& particles) {
  return HWY_DYNAMIC_DISPATCH(project_near_edges)(grid, placement, longest_step, range, edges, particles);
}

void gather_low_edges(const DistanceSet& distances, ColorRange color, const std::vector<float>& clearance, float reach,
                      float per_length, std::vector<Index>& slots) {
  HWY_DYNAMIC_DISPATCH(gather_low_edges)(distances, color, clearance, reach, per_length, slots);
}

}  // namespace gracilis
#endif
