// 3 × 3 matrices, one per lane, and columns of them in memory. Included once per instruction set.

#if defined(GRACILIS_MATRIX_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_MATRIX_LANES_INL
#undef GRACILIS_MATRIX_LANES_INL
#else
#define GRACILIS_MATRIX_LANES_INL
#endif

#include <gracilis/strings/symmetric_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// By its rows.
struct Matrix {
  Point x, y, z;
};

HWY_INLINE Matrix operator+(Matrix a, Matrix b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HWY_INLINE Matrix operator-(Matrix a, Matrix b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HWY_INLINE Matrix scaled(V s, Matrix a) { return {scaled(s, a.x), scaled(s, a.y), scaled(s, a.z)}; }
HWY_INLINE Matrix zero_matrix() {
  const V zero = hn::Zero(D());
  return {{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}};
}
HWY_INLINE Matrix full(const SymmetricLanes& a) { return {{a.xx, a.xy, a.xz}, {a.xy, a.yy, a.yz}, {a.xz, a.yz, a.zz}}; }
/// a bᵀ
HWY_INLINE Matrix outer(Point a, Point b) { return {scaled(a.x, b), scaled(a.y, b), scaled(a.z, b)}; }
HWY_INLINE Matrix plus_diagonal(Matrix a, V k) {
  a.x.x = a.x.x + k, a.y.y = a.y.y + k, a.z.z = a.z.z + k;
  return a;
}
/// p + s a
HWY_INLINE Point plus_scaled(Point p, V s, Point a) {
  return {hn::MulAdd(s, a.x, p.x), hn::MulAdd(s, a.y, p.y), hn::MulAdd(s, a.z, p.z)};
}
HWY_INLINE Point times(Matrix a, Point p) { return {dot<Math>(a.x, p), dot<Math>(a.y, p), dot<Math>(a.z, p)}; }
HWY_INLINE Point transposed_times(Matrix a, Point p) {
  return plus_scaled(plus_scaled(scaled(p.z, a.z), p.y, a.y), p.x, a.x);
}
HWY_INLINE Matrix times(Matrix a, Matrix b) {
  return {transposed_times(b, a.x), transposed_times(b, a.y), transposed_times(b, a.z)};
}
/// a [v]×, which takes p to a (v × p).
HWY_INLINE Matrix times_cross(Matrix a, Point v) { return {cross(a.x, v), cross(a.y, v), cross(a.z, v)}; }
/// (I - d dᵀ) a
HWY_INLINE Matrix across(Point d, Matrix a) { return a - outer(d, transposed_times(a, d)); }

/// By the adjugate, with the determinant.
HWY_INLINE Matrix inverse(Matrix a, V& determinant) {
  const Point x = cross(a.y, a.z), y = cross(a.z, a.x), z = cross(a.x, a.y);
  determinant = dot<Math>(a.x, x);
  const V r = lanes_of(1) / determinant;
  return {{r * x.x, r * y.x, r * z.x}, {r * x.y, r * y.y, r * z.y}, {r * x.z, r * y.z, r * z.z}};
}

/// The same vector in each lane.
HWY_INLINE Point lanes_of(const Eigen::Vector3f& v) { return {lanes_of(v.x()), lanes_of(v.y()), lanes_of(v.z())}; }

/// Points and matrices of a group of nodes lie in a row, number by number: 3 or 9 times as many lanes as nodes.
HWY_INLINE Point load_point(const float* p) {
  const std::size_t n = hn::Lanes(D());
  return {hn::LoadU(D(), p), hn::LoadU(D(), p + n), hn::LoadU(D(), p + 2 * n)};
}
HWY_INLINE void store_point(Point a, float* p) {
  const std::size_t n = hn::Lanes(D());
  hn::StoreU(a.x, D(), p), hn::StoreU(a.y, D(), p + n), hn::StoreU(a.z, D(), p + 2 * n);
}
HWY_INLINE Matrix load_matrix(const float* p) {
  const std::size_t n = 3 * hn::Lanes(D());
  return {load_point(p), load_point(p + n), load_point(p + 2 * n)};
}
HWY_INLINE void store_matrix(Matrix a, float* p) {
  const std::size_t n = 3 * hn::Lanes(D());
  store_point(a.x, p), store_point(a.y, p + n), store_point(a.z, p + 2 * n);
}
HWY_INLINE void add_matrix(Matrix a, float* p) { store_matrix(load_matrix(p) + a, p); }

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
