// The angle between two triangles and its gradient, for any number type. Included once per instruction set, hence the
// guard that flips with each of Highway's passes; a plain include (tests) uses the baseline.

#if defined(GRACILIS_DIHEDRAL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_DIHEDRAL_INL
#undef GRACILIS_DIHEDRAL_INL
#else
#define GRACILIS_DIHEDRAL_INL
#endif

#include <gracilis/dynamics/simd/number_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// The signed angle between two triangles at an edge and its gradient at the four points; all zero where a triangle or
/// the edge has no area.
template <class V>
struct DihedralAngle {
  V angle;
  Vector3<V> g0, g1, g2, g3;
  V valid;  ///< 1, or 0 where a triangle or the edge is degenerate
};

/// Shares the apex gradients g2 and g3 among the edge's ends so that the gradient moves neither position nor direction.
template <class Math, class V = typename Math::V>
HWY_INLINE void balance_edge_ends(Vector3<V> e, Vector3<V> a, Vector3<V> b, V inverse_length2,
                                  DihedralAngle<V>& dihedral) {
  const V ta = dot<Math>(a, e) * inverse_length2, tb = dot<Math>(b, e) * inverse_length2;
  const V one = Math::number(1), zero = Math::number(0);
  dihedral.g0 = scaled(ta - one, dihedral.g2) + scaled(tb - one, dihedral.g3);
  dihedral.g1 = scaled(zero - ta, dihedral.g2) + scaled(zero - tb, dihedral.g3);
}

/// θ = atan2((n1 × n2)·e/|e|, n1·n2) with e = x1 - x0, n1 = e × (x2 - x0), n2 = (x3 - x0) × e: 0 when flat, defined up
/// to ±π (Bridson, Marino, Fedkiw 2003; gradients by differentiation).
template <class Math, class V = typename Math::V>
HWY_INLINE DihedralAngle<V> dihedral_angle(Vector3<V> x0, Vector3<V> x1, Vector3<V> x2, Vector3<V> x3) {
  const Vector3<V> e = x1 - x0, a = x2 - x0, b = x3 - x0;
  const Vector3<V> n1 = cross(e, a), n2 = cross(b, e);
  const V length2 = dot<Math>(e, e), n1_squared = dot<Math>(n1, n1), n2_squared = dot<Math>(n2, n2);
  // A triangle thinner than a ten-thousandth of its edge has no usable normal.
  const V zero = Math::number(0), one = Math::number(1),
          floor = Math::number(1e-8) * length2 * length2 + Math::number(1e-30);
  const V smaller = Math::min(n1_squared, n2_squared);
  DihedralAngle<V> dihedral;
  dihedral.valid = Math::if_less(smaller, floor, zero, one);
  const V inverse_length = dihedral.valid * Math::inverse_sqrt(Math::max(length2, Math::number(1e-30)));
  const V length = length2 * inverse_length;
  dihedral.angle = dihedral.valid * atan2<Math>(dot<Math>(cross(n1, n2), e) * inverse_length, dot<Math>(n1, n2));
  dihedral.g2 = scaled(zero - length * Math::reciprocal(Math::max(n1_squared, floor)), n1);
  dihedral.g3 = scaled(zero - length * Math::reciprocal(Math::max(n2_squared, floor)), n2);
  balance_edge_ends<Math>(e, a, b, inverse_length * inverse_length, dihedral);
  return dihedral;
}

/// The published variant: θ = arccos(n1·n2) of unit normals, without sign; its gradient has the factor 1/√(1 -
/// (n1·n2)²) that is lost near flat and folded edges, which are therefore skipped (Müller et al. 2007, appendix A).
template <class Math, class V = typename Math::V>
HWY_INLINE DihedralAngle<V> dihedral_angle_arccos(Vector3<V> x0, Vector3<V> x1, Vector3<V> x2, Vector3<V> x3) {
  DihedralAngle<V> dihedral = dihedral_angle<Math>(x0, x1, x2, x3);
  const V zero = Math::number(0);
  const V cosine_lost = Math::number(1e-3);  // below this angle float's 1 - cos θ has no digits left
  const V unsigned_angle = Math::abs(dihedral.angle);
  const V distance_to_flat = Math::min(unsigned_angle, Math::number(3.14159265358979323846) - unsigned_angle);
  dihedral.valid = Math::if_less(distance_to_flat, cosine_lost, zero, dihedral.valid);
  const V sign = Math::copy_sign(dihedral.valid, dihedral.angle);
  dihedral.angle = unsigned_angle;
  dihedral.g0 = scaled(sign, dihedral.g0), dihedral.g1 = scaled(sign, dihedral.g1);
  dihedral.g2 = scaled(sign, dihedral.g2), dihedral.g3 = scaled(sign, dihedral.g3);
  return dihedral;
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
