// Sums over many lanes that do not depend on how many there are at once. Included once per instruction set.

#if defined(GRACILIS_LANE_SUM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_LANE_SUM_INL
#undef GRACILIS_LANE_SUM_INL
#else
#define GRACILIS_LANE_SUM_INL
#endif

#include <gracilis/dynamics/simd/particle_lanes-inl.hpp>

#include <Eigen/Core>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// Adds group_width numbers in pairs, halves upon halves.
HWY_INLINE float sum_in_pairs(float* numbers) {
  for (std::size_t half = group_width / 2; half > 0; half /= 2)
    for (std::size_t k = 0; k < half; ++k) numbers[k] += numbers[k + half];
  return numbers[0];
}

/// Vectors that hold group_width numbers.
inline constexpr std::size_t lane_parts = static_cast<std::size_t>(group_width) / hn::MaxLanes(D());

/// Calls act(at, part) for each vector of `count` numbers, a multiple of group_width, and says which part of
/// group_width numbers it is.
template <class Act>
HWY_INLINE void for_lane_parts(std::size_t count, const Act& act) {
  for (std::size_t at = 0; at < count; at += group_width)
    for (std::size_t lane = 0; lane < group_width; lane += hn::Lanes(D()))
      act(at + lane, lane / hn::Lanes(D()) % lane_parts);
}

/// Some sums at once. Where registers hold fewer than group_width numbers, they are added as if side by side in wider
/// ones: the same bits on every machine.
template <std::size_t Count>
class LaneSums {
 public:
  HWY_INLINE LaneSums() {
    for (auto& part : parts_)
      for (V& each : part) each = hn::Zero(D());
  }

  HWY_INLINE V& operator()(std::size_t k, std::size_t part) { return parts_[part][k]; }
  HWY_INLINE void add(std::size_t k, std::size_t part, V x) { parts_[part][k] = parts_[part][k] + x; }
  /// Of three sums from k on.
  HWY_INLINE void add(std::size_t k, std::size_t part, Point p) {
    add(k, part, p.x), add(k + 1, part, p.y), add(k + 2, part, p.z);
  }

  HWY_INLINE float total(std::size_t k) const {
    HWY_ALIGN float numbers[group_width] = {};
    for (std::size_t part = 0; part < lane_parts; ++part)
      hn::Store(parts_[part][k], D(), numbers + part * hn::Lanes(D()));
    return sum_in_pairs(numbers);
  }
  HWY_INLINE Eigen::Vector3f total_point(std::size_t k) const { return {total(k), total(k + 1), total(k + 2)}; }

 private:
  V parts_[lane_parts][Count];
};

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
