#include <gracilis/strings/lane_places.hpp>

#include <gracilis/dynamics/simd/group_width.hpp>

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gracilis/strings/lane_places.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway asks.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using strings::LanePlaces;
using strings::StringLanes;

using Doubles = hn::CappedTag<double, group_width / 2>;
using Affine3d = Eigen::Matrix<Real, 3, 4>;

void carry_lanes(const StringLanes& lanes, const std::vector<RigidTransform>& before,
                 const std::vector<RigidTransform>& now, LanePlaces& places) {
  const Doubles d;
  const hn::Rebind<float, Doubles> floats;
  using N = hn::Vec<Doubles>;
  std::vector<Affine3d> motions;
  for (const Index body : lanes.bodies) {
    const auto b = static_cast<std::size_t>(body);
    motions.emplace_back((now[b] * before[b].inverse()).affine());
  }
  for (std::size_t at = 0; at < places[0].size(); at += hn::Lanes(d)) {
    const N x = hn::LoadU(d, &places[0][at]), y = hn::LoadU(d, &places[1][at]), z = hn::LoadU(d, &places[2][at]);
    N sum[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)}, shares = hn::Zero(d);
    for (std::size_t b = 0; b < motions.size(); ++b) {
      const N share = hn::PromoteTo(d, hn::LoadU(floats, &lanes.shares[b][at]));
      shares = shares + share;
      for (Index row = 0; row < 3; ++row) {
        const auto number = [&](Index column) HWY_ATTR { return hn::Set(d, motions[b](row, column)); };
        const N moved = hn::MulAdd(number(0), x, hn::MulAdd(number(1), y, hn::MulAdd(number(2), z, number(3))));
        sum[row] = hn::MulAdd(share, moved, sum[row]);
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) hn::StoreU(sum[axis] / shares, d, &places[axis][at]);
  }
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gracilis {

HWY_EXPORT(carry_lanes);

namespace strings {

LanePlaces lane_places(const StringLanes& lanes, const Points& places) {
  LanePlaces result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result[axis].resize(static_cast<std::size_t>(lanes.width * lanes.nodes));
    for (Index s = 0; s < lanes.width; ++s)
      for (Index i = 0; i < lanes.nodes; ++i)
        result[axis][static_cast<std::size_t>(i * lanes.width + s)] =
            places(static_cast<Index>(axis), std::min(s, lanes.strings - 1) * lanes.nodes + i);
  }
  return result;
}

Points places_of(const StringLanes& lanes, const LanePlaces& places) {
  Points result(3, lanes.strings * lanes.nodes);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (Index s = 0; s < lanes.strings; ++s)
      for (Index i = 0; i < lanes.nodes; ++i)
        result(static_cast<Index>(axis), s * lanes.nodes + i) =
            places[axis][static_cast<std::size_t>(i * lanes.width + s)];
  return result;
}

void carry_lanes(const StringLanes& lanes, const std::vector<RigidTransform>& before,
                 const std::vector<RigidTransform>& now, LanePlaces& places) {
  HWY_DYNAMIC_DISPATCH(carry_lanes)(lanes, before, now, places);
}

}  // namespace strings
}  // namespace gracilis
#endif
