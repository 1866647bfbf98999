#include <gracilis/dynamics/constraints/strain_limit.hpp>

#include <hwy/cache_control.h>

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/dynamics/constraints/strain_limit.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/dynamics/constraints/edge_ends-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

Index project_strain_limit(const DistanceSet& set, ColorRange range, float limit, Particles& particles,
                           const StrainLimitActiveSet* active) {
  const D d;
  const auto is_active = [active](std::size_t at) { return !active || active->groups[at / group_width]; };
  // Few of many, in no order that the processor could predict.
  for (auto at = static_cast<std::size_t>(range.begin); at < static_cast<std::size_t>(range.end); at += group_width)
    if (is_active(at)) {
      hwy::Prefetch(set.a.data() + at);
      hwy::Prefetch(set.b.data() + at);
      hwy::Prefetch(set.rest_length.data() + at);
    }
  Index limited = 0;
  for (Index slot = range.begin; slot < range.end; slot += static_cast<Index>(hn::Lanes(d))) {
    const auto at = static_cast<std::size_t>(slot);
    if (!is_active(at)) continue;
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

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(project_strain_limit);

namespace {

/// How far the ends of an edge may part within one iteration: over the longest edge at either, as short edges go with
/// what moves the long ones beside them; and at most, m.
constexpr float reserve_share = 0.5f, largest_reserve = 0.002f;

/// Of each particle, the idle one too, the longest edge that ends there, m.
std::vector<float> longest_edges(const DistanceSet& set) {
  std::vector<float> longest;
  for (std::size_t slot = 0; slot < set.a.size(); ++slot)
    for (const Index end : {set.a[slot], set.b[slot]}) {
      const auto particle = static_cast<std::size_t>(end);
      if (longest.size() <= particle) longest.resize(particle + 1, 0);
      longest[particle] = std::max(longest[particle], set.rest_length[slot]);
    }
  return longest;
}

}  // namespace

void build_active_set(const DistanceSet& set, float limit, StrainLimitActiveSet& active) {
  if (active.limit == limit && active.from.size() == set.a.size()) return;
  active.limit = limit;
  active.from.resize(set.a.size());
  active.groups.assign(set.a.size() / group_width, 1);
  const std::vector<float> longest = longest_edges(set);
  for (std::size_t slot = 0; slot < set.a.size(); ++slot) {
    const float nearby =
        std::max(longest[static_cast<std::size_t>(set.a[slot])], longest[static_cast<std::size_t>(set.b[slot])]);
    active.from[slot] = limit * set.rest_length[slot] - std::min(reserve_share * nearby, largest_reserve);
  }
}

void deactivate_all(StrainLimitActiveSet& active) { std::fill(active.groups.begin(), active.groups.end(), 0); }

void activate_all(StrainLimitActiveSet& active) { std::fill(active.groups.begin(), active.groups.end(), 1); }

Index project_strain_limit(const DistanceSet& set, ColorRange range, float limit, Particles& particles,
                           const StrainLimitActiveSet* active) {
  return HWY_DYNAMIC_DISPATCH(project_strain_limit)(set, range, limit, particles, active);
}

}  // namespace gracilis
#endif
