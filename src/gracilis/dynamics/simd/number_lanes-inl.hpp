// Arithmetic of numbers and points that is the same for a vector of lanes and for one number. Included once per
// instruction set, hence the guard that flips with each of Highway's passes; a plain include (tests) uses the baseline.

#if defined(GRACILIS_NUMBER_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_NUMBER_LANES_INL
#undef GRACILIS_NUMBER_LANES_INL
#else
#define GRACILIS_NUMBER_LANES_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The operations kernels need, for a vector of lanes ...
template <class D>
struct Lanes {
  using V = hn::Vec<D>;
  static HWY_INLINE V number(double x) { return hn::Set(D(), static_cast<hn::TFromD<D>>(x)); }
  static HWY_INLINE V sqrt(V x) { return hn::Sqrt(x); }
  static HWY_INLINE V abs(V x) { return hn::Abs(x); }
  static HWY_INLINE V min(V x, V y) { return hn::Min(x, y); }
  static HWY_INLINE V max(V x, V y) { return hn::Max(x, y); }
  static HWY_INLINE V fma(V x, V y, V z) { return hn::MulAdd(x, y, z); }
  static HWY_INLINE V copy_sign(V x, V sign) { return hn::CopySign(x, sign); }
  /// x < y ? a : b
  static HWY_INLINE V if_less(V x, V y, V a, V b) { return hn::IfThenElse(hn::Lt(x, y), a, b); }
  /// 1 / x and 1 / √x for x > 0, rounded correctly: the estimates that machines offer are faster, but each maker's
  /// differ in last bits, and so would results.
  static HWY_INLINE V reciprocal(V x) { return number(1) / x; }
  static HWY_INLINE V inverse_sqrt(V x) { return number(1) / hn::Sqrt(x); }
};

/// ... and for one number, so that tests can ask for double precision.
struct Scalar {
  using V = double;
  static V number(double x) { return x; }
  static V sqrt(V x) { return std::sqrt(x); }
  static V abs(V x) { return std::abs(x); }
  static V min(V x, V y) { return std::min(x, y); }
  static V max(V x, V y) { return std::max(x, y); }
  static V fma(V x, V y, V z) { return x * y + z; }
  static V copy_sign(V x, V sign) { return std::copysign(x, sign); }
  static V if_less(V x, V y, V a, V b) { return x < y ? a : b; }
  static V reciprocal(V x) { return 1 / x; }
  static V inverse_sqrt(V x) { return 1 / std::sqrt(x); }
};

/// Goes by value: GCC writes to memory what is referred to, even where nobody reads it there.
template <class V>
struct Vector3 {
  V x, y, z;
};
template <class V>
HWY_INLINE Vector3<V> operator+(Vector3<V> a, Vector3<V> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
HWY_INLINE Vector3<V> operator-(Vector3<V> a, Vector3<V> b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
HWY_INLINE Vector3<V> scaled(V s, Vector3<V> a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class Math, class V = typename Math::V>
HWY_INLINE V dot(Vector3<V> a, Vector3<V> b) {
  return Math::fma(a.x, b.x, Math::fma(a.y, b.y, a.z * b.z));
}
template <class V>
HWY_INLINE Vector3<V> cross(Vector3<V> a, Vector3<V> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Angle of the vector (x, y), rad in [-π, π], 0 for the zero vector. The arctangent on [0, 1] is the polynomial 4.4.49
/// of Abramowitz and Stegun (1964), error at most 2e-8.
template <class Math, class V = typename Math::V>
HWY_INLINE V atan2(V y, V x) {
  const V zero = Math::number(0), half_turn = Math::number(3.14159265358979323846),
          quarter = Math::number(1.57079632679489661923);
  const V ax = Math::abs(x), ay = Math::abs(y);
  const V t = Math::min(ax, ay) * Math::reciprocal(Math::max(Math::max(ax, ay), Math::number(1e-37)));
  const V s = t * t;
  V p = Math::number(0.0028662257);
  p = Math::fma(p, s, Math::number(-0.0161657367));
  p = Math::fma(p, s, Math::number(0.0429096138));
  p = Math::fma(p, s, Math::number(-0.0752896400));
  p = Math::fma(p, s, Math::number(0.1065626393));
  p = Math::fma(p, s, Math::number(-0.1420889944));
  p = Math::fma(p, s, Math::number(0.1999355085));
  p = Math::fma(p, s, Math::number(-0.3333314528));
  V angle = Math::fma(p * s, t, t);
  angle = Math::if_less(ax, ay, quarter - angle, angle);
  angle = Math::if_less(x, zero, half_turn - angle, angle);
  return Math::copy_sign(angle, y);
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
