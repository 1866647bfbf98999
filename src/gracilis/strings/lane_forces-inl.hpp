// Forces on strings and their Gauss-Newton step, a string per lane. Included once per instruction set.

#if defined(GRACILIS_LANE_FORCES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_LANE_FORCES_INL
#undef GRACILIS_LANE_FORCES_INL
#else
#define GRACILIS_LANE_FORCES_INL
#endif

#include <gracilis/strings/field_spline_lanes-inl.hpp>
#include <gracilis/strings/lane_workspace.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

using strings::LanePoints;
using strings::LaneWorkspace;

HWY_INLINE V load(const std::vector<float>& numbers, std::size_t at) { return hn::LoadU(D(), numbers.data() + at); }
HWY_INLINE void store(V x, std::vector<float>& numbers, std::size_t at) { hn::StoreU(x, D(), numbers.data() + at); }
HWY_INLINE Point load(const LanePoints& points, std::size_t at) {
  return {load(points[0], at), load(points[1], at), load(points[2], at)};
}
HWY_INLINE void store(Point p, LanePoints& points, std::size_t at) {
  store(p.x, points[0], at), store(p.y, points[1], at), store(p.z, points[2], at);
}
HWY_INLINE SymmetricLanes load(const std::array<std::vector<float>, 6>& a, std::size_t at) {
  return {load(a[0], at), load(a[1], at), load(a[2], at), load(a[3], at), load(a[4], at), load(a[5], at)};
}
HWY_INLINE void store(const SymmetricLanes& s, std::array<std::vector<float>, 6>& a, std::size_t at) {
  store(s.xx, a[0], at), store(s.xy, a[1], at), store(s.xz, a[2], at);
  store(s.yy, a[3], at), store(s.yz, a[4], at), store(s.zz, a[5], at);
}

using Affine = Eigen::Matrix<float, 3, 4>;

HWY_INLINE Point apply(const Affine& m, Point p) {
  const auto row = [&](Index i) HWY_ATTR {
    return hn::MulAdd(lanes_of(m(i, 0)), p.x,
                      hn::MulAdd(lanes_of(m(i, 1)), p.y, hn::MulAdd(lanes_of(m(i, 2)), p.z, lanes_of(m(i, 3)))));
  };
  return {row(0), row(1), row(2)};
}
/// Without the translation.
HWY_INLINE Point turn(const Affine& m, Point p) {
  const auto row = [&](Index i) HWY_ATTR {
    return hn::MulAdd(lanes_of(m(i, 0)), p.x, hn::MulAdd(lanes_of(m(i, 1)), p.y, lanes_of(m(i, 2)) * p.z));
  };
  return {row(0), row(1), row(2)};
}

HWY_INLINE Point unit(Point p) { return scaled(Math::inverse_sqrt(hn::Max(dot<Math>(p, p), lanes_of(1e-20f))), p); }
HWY_INLINE Point across(Point direction, Point p) { return p - scaled(dot<Math>(direction, p), direction); }

/// The system of a node while its forces are summed.
struct NodeSystem {
  SymmetricLanes stiffness;
  Point gradient;

  /// A spring along n, stretched by e.
  HWY_INLINE void add_spring(V k, Point n, V e) {
    stiffness = plus_outer(stiffness, k, n);
    gradient = gradient + scaled(k * e, n);
  }
  /// A spring across a direction, from `to` to `from`.
  HWY_INLINE void add_across(V k, Point direction, Point from_to) {
    stiffness.xx = stiffness.xx + k, stiffness.yy = stiffness.yy + k, stiffness.zz = stiffness.zz + k;
    stiffness = plus_outer(stiffness, hn::Zero(D()) - k, direction);
    gradient = gradient + scaled(k, across(direction, from_to));
  }
};

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
