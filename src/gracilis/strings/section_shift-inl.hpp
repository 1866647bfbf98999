// How whole cross-sections move before single strings do. Included once per instruction set.

#if defined(GRACILIS_SECTION_SHIFT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_SECTION_SHIFT_INL
#undef GRACILIS_SECTION_SHIFT_INL
#else
#define GRACILIS_SECTION_SHIFT_INL
#endif

#include <gracilis/strings/lane_forces-inl.hpp>
#include <gracilis/strings/lane_sum-inl.hpp>

#include <Eigen/LU>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// How a node moves with its section; held ones do not.
HWY_INLINE Point section_shift(const strings::StringLanes& lanes, const LaneWorkspace& w, std::size_t i,
                               std::size_t s) {
  const Eigen::Vector3f& shift = w.sections[i].shift;
  const V free = load(lanes.free, i * static_cast<std::size_t>(lanes.width) + s);
  return {free * lanes_of(shift.x()), free * lanes_of(shift.y()), free * lanes_of(shift.z())};
}

/// Strings hold each other's places, so one by one a bundle moves slowly: its sections go ahead, all strings of one by
/// the same vector. That is the coarse part of a two-level solve; the strings' own steps follow from there.
class SectionShift {
 public:
  /// `neighbor`: what neighbors hold a node with over its length, 1/m².
  SectionShift(const strings::StringLanes& lanes, float neighbor, LaneWorkspace& workspace)
      : lanes_(lanes),
        neighbor_(lanes_of(neighbor)),
        w_(workspace),
        width_(static_cast<std::size_t>(lanes.width)),
        inner_(static_cast<std::size_t>(lanes.nodes - 1)) {}

  /// Finds the shifts by the strings' systems and takes their forces from these. Returns the largest, m.
  float apply() {
    w_.sections.assign(inner_ + 1, {});
    for (std::size_t i = 1; i < inner_; ++i) sum_section(i);
    const float largest = solve();
    for (std::size_t s = 0; s < width_; s += hn::Lanes(D()))
      for (std::size_t i = 1; i < inner_; ++i) take_forces(i, s);
    return largest;
  }

 private:
  /// A node's stiffness but for its neighbors, which go along.
  HWY_INLINE SymmetricLanes stiffness(std::size_t at, std::size_t s) const {
    const V k = neighbor_ * load(lanes_.node_length, s);
    SymmetricLanes own = load(w_.stiffness, at);
    own.xx = own.xx - k, own.yy = own.yy - k, own.zz = own.zz - k;
    return plus_outer(own, k, load(w_.direction, at));
  }

  HWY_INLINE void sum_section(std::size_t i) {
    const D d;
    const auto strings = static_cast<std::size_t>(lanes_.strings);
    LaneSums<10> sums;  // stiffness, forces, and how strings couple it to the next
    for_lane_parts(width_, [&](std::size_t s, std::size_t part) HWY_ATTR {
      const std::size_t at = i * width_ + s;
      const auto counted =
          hn::And(hn::FirstN(d, s < strings ? strings - s : 0), hn::Gt(load(lanes_.free, at), hn::Zero(d)));
      const SymmetricLanes own = stiffness(at, s);
      const Point force = load(w_.gradient, at);
      const V coupling = load(lanes_.tension, s) * load(lanes_.free, at + width_);
      const V all[] = {own.xx, own.xy, own.xz, own.yy, own.yz, own.zz, force.x, force.y, force.z, coupling};
      for (std::size_t k = 0; k < 10; ++k) sums.add(k, part, hn::IfThenElseZero(counted, all[k]));
    });
    LaneWorkspace::Section& section = w_.sections[i];
    const float xy = sums.total(1), xz = sums.total(2), yz = sums.total(4);
    section.stiffness << sums.total(0), xy, xz, xy, sums.total(3), yz, xz, yz, sums.total(5);
    section.shift = -sums.total_point(6);
    section.coupling = sums.total(9);
  }

  /// Block elimination (Thomas). A section without free strings stays.
  float solve() {
    Eigen::Matrix3f before = Eigen::Matrix3f::Zero();
    for (std::size_t i = 1; i < inner_; ++i) {
      LaneWorkspace::Section& section = w_.sections[i];
      const LaneWorkspace::Section& last = w_.sections[i - 1];
      const float c = last.coupling;
      section.shift += c * before * last.shift;
      before = section.stiffness - c * c * before;
      if (before.trace() > 0)
        before = before.inverse().eval();
      else
        before.setZero();
      section.stiffness = before;
    }
    float largest = 0;
    for (std::size_t i = inner_ - 1; i > 0; --i) {
      LaneWorkspace::Section& section = w_.sections[i];
      section.shift += section.coupling * w_.sections[i + 1].shift;
      section.shift = (section.stiffness * section.shift).eval();
      largest = std::max(largest, section.shift.norm());
    }
    return largest;
  }

  HWY_INLINE void take_forces(std::size_t i, std::size_t s) {
    const std::size_t at = i * width_ + s;
    const Point own = section_shift(lanes_, w_, i, s),
                beside = section_shift(lanes_, w_, i - 1, s) + section_shift(lanes_, w_, i + 1, s);
    store(load(w_.gradient, at) + times(stiffness(at, s), own) - scaled(load(lanes_.tension, s), beside), w_.gradient,
          at);
  }

  const strings::StringLanes& lanes_;
  const V neighbor_;
  LaneWorkspace& w_;
  std::size_t width_, inner_;
};

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
