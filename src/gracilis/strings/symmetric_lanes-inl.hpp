// Symmetric 3 × 3 matrices, one per lane. Included once per instruction set.

#if defined(GRACILIS_SYMMETRIC_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_SYMMETRIC_LANES_INL
#undef GRACILIS_SYMMETRIC_LANES_INL
#else
#define GRACILIS_SYMMETRIC_LANES_INL
#endif

#include <gracilis/dynamics/simd/particle_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

HWY_INLINE V lanes_of(float x) { return hn::Set(D(), x); }

struct SymmetricLanes {
  V xx, xy, xz, yy, yz, zz;
};

HWY_INLINE SymmetricLanes diagonal(V k) {
  const V zero = hn::Zero(D());
  return {k, zero, zero, k, zero, k};
}

/// a + k n nᵀ
HWY_INLINE SymmetricLanes plus_outer(const SymmetricLanes& a, V k, Point n) {
  const Point kn = scaled(k, n);
  return {hn::MulAdd(kn.x, n.x, a.xx), hn::MulAdd(kn.x, n.y, a.xy), hn::MulAdd(kn.x, n.z, a.xz),
          hn::MulAdd(kn.y, n.y, a.yy), hn::MulAdd(kn.y, n.z, a.yz), hn::MulAdd(kn.z, n.z, a.zz)};
}

/// a - k b
HWY_INLINE SymmetricLanes minus_scaled(const SymmetricLanes& a, V k, const SymmetricLanes& b) {
  return {hn::NegMulAdd(k, b.xx, a.xx), hn::NegMulAdd(k, b.xy, a.xy), hn::NegMulAdd(k, b.xz, a.xz),
          hn::NegMulAdd(k, b.yy, a.yy), hn::NegMulAdd(k, b.yz, a.yz), hn::NegMulAdd(k, b.zz, a.zz)};
}

HWY_INLINE Point times(const SymmetricLanes& a, Point b) {
  return {hn::MulAdd(a.xx, b.x, hn::MulAdd(a.xy, b.y, a.xz * b.z)),
          hn::MulAdd(a.xy, b.x, hn::MulAdd(a.yy, b.y, a.yz * b.z)),
          hn::MulAdd(a.xz, b.x, hn::MulAdd(a.yz, b.y, a.zz * b.z))};
}

/// By the adjugate; `a` must be positive definite.
HWY_INLINE SymmetricLanes inverse(const SymmetricLanes& a) {
  const V xx = a.yy * a.zz - a.yz * a.yz, xy = a.xz * a.yz - a.xy * a.zz, xz = a.xy * a.yz - a.xz * a.yy;
  const V r = lanes_of(1) / hn::MulAdd(a.xx, xx, hn::MulAdd(a.xy, xy, a.xz * xz));
  return {xx * r,
          xy * r,
          xz * r,
          (a.xx * a.zz - a.xz * a.xz) * r,
          (a.xy * a.xz - a.xx * a.yz) * r,
          (a.xx * a.yy - a.xy * a.xy) * r};
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
