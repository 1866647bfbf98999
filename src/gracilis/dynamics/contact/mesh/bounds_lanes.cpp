#include <gracilis/dynamics/contact/mesh/bounds_lanes.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/dynamics/contact/mesh/bounds_lanes.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <gracilis/dynamics/simd/particle_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

void find_meeting_patches(const BoundsLanes& bounds, const PatchTree::Bounds& near, float reach,
                          std::vector<Index>& patches) {
  const D d;
  constexpr std::size_t lanes = hn::MaxLanes(D());
  patches.clear();
  for (std::size_t at = 0; at < bounds.nodes.size(); at += lanes) {
    V gap = hn::Set(d, -PatchTree::infinity), least_cosine = hn::Zero(d);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto row = static_cast<Index>(axis);
      const V below = hn::Load(d, bounds.low[axis].data() + at) - hn::Set(d, near.places.high[row]),
              above = hn::Set(d, near.places.low[row]) - hn::Load(d, bounds.high[axis].data() + at);
      gap = hn::Max(gap, hn::Max(below, above));
      const V a = hn::Set(d, near.normals.low[row]), b = hn::Set(d, near.normals.high[row]),
              low = hn::Load(d, bounds.low_normal[axis].data() + at),
              high = hn::Load(d, bounds.high_normal[axis].data() + at);
      least_cosine = least_cosine + hn::Min(hn::Min(a * low, a * high), hn::Min(b * low, b * high));
    }
    const hn::Mask<D> meets = hn::And(hn::Le(gap, hn::Set(d, reach)), hn::Lt(least_cosine, hn::Set(d, facing_cosine)));
    for_each_lane(meets, [&](std::size_t lane) { patches.push_back(bounds.nodes[at + lane]); });
  }
}

void find_near_patches(const BoundsLanes& bounds, const Eigen::Vector3f& p, const Eigen::Vector3f& outward, float reach,
                       std::vector<NearPatch>& near) {
  const D d;
  constexpr std::size_t lanes = hn::MaxLanes(D());
  const V zero = hn::Zero(d), reach2 = hn::Set(d, reach * reach);
  near.clear();
  for (std::size_t at = 0; at < bounds.nodes.size(); at += lanes) {
    V distance2 = zero, least_along = zero;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const V x = hn::Set(d, p[static_cast<Index>(axis)]), n = hn::Set(d, outward[static_cast<Index>(axis)]);
      const V beyond = hn::Max(
          hn::Max(hn::Load(d, bounds.low[axis].data() + at) - x, x - hn::Load(d, bounds.high[axis].data() + at)), zero);
      distance2 = hn::MulAdd(beyond, beyond, distance2);
      least_along = least_along + hn::Min(n * hn::Load(d, bounds.low_normal[axis].data() + at),
                                          n * hn::Load(d, bounds.high_normal[axis].data() + at));
    }
    const hn::Mask<D> is_near = hn::And(hn::Le(distance2, reach2), hn::Le(least_along, zero));
    if (hn::AllFalse(d, is_near)) continue;
    HWY_ALIGN float distances2[lanes];
    hn::Store(distance2, d, distances2);
    for_each_lane(is_near, [&](std::size_t lane) { near.push_back({bounds.nodes[at + lane], distances2[lane]}); });
  }
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(find_meeting_patches);
HWY_EXPORT(find_near_patches);

void find_meeting_patches(const BoundsLanes& bounds, const PatchTree::Bounds& near, float reach,
                          std::vector<Index>& patches) {
  HWY_DYNAMIC_DISPATCH(find_meeting_patches)(bounds, near, reach, patches);
}

void find_near_patches(const BoundsLanes& bounds, const Eigen::Vector3f& p, const Eigen::Vector3f& outward, float reach,
                       std::vector<NearPatch>& near) {
  HWY_DYNAMIC_DISPATCH(find_near_patches)(bounds, p, outward, reach, near);
}

void BoundsLanes::load(const PatchTree& tree, const std::vector<Index>& patches) {
  nodes = patches;
  const std::size_t size = (nodes.size() + group_width - 1) / group_width * group_width;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (Rows* rows : {&low, &high, &low_normal, &high_normal}) (*rows)[axis].assign(size, PatchTree::infinity);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const PatchTree::Bounds& from = tree.bounds[static_cast<std::size_t>(nodes[i])];
      const auto row = static_cast<Index>(axis);
      low[axis][i] = from.places.low[row], high[axis][i] = from.places.high[row];
      low_normal[axis][i] = from.normals.low[row], high_normal[axis][i] = from.normals.high[row];
    }
  }
}

}  // namespace gracilis
#endif
