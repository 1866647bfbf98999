// Constraint kernels: pure functions of a few points, for any number type. Included once per instruction set, hence the
// guard that flips with each of Highway's passes; a plain include (tests) uses the baseline.

#if defined(GRACILIS_KERNELS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_KERNELS_INL
#undef GRACILIS_KERNELS_INL
#else
#define GRACILIS_KERNELS_INL
#endif

#include <gracilis/dynamics/simd/number_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace gracilis::HWY_NAMESPACE {

/// Length of an edge and its unit direction, the gradient at b; the gradient at a is its opposite. The direction of an
/// edge without length is zero, so that such an edge moves nothing.
template <class V>
struct EdgeLength {
  V length;
  Vector3<V> direction;
};
template <class Math, class V = typename Math::V>
HWY_INLINE EdgeLength<V> edge_length(Vector3<V> a, Vector3<V> b) {
  const Vector3<V> d = b - a;
  const V length2 = dot<Math>(d, d), tiny = Math::number(1e-24), zero = Math::number(0);
  const V inverse = Math::if_less(length2, tiny, zero, Math::inverse_sqrt(Math::max(length2, tiny)));
  return {length2 * inverse, scaled(inverse, d)};
}

/// The signed angle at a hinge and its gradient at the four points; all zero where a triangle or the edge has no area.
template <class V>
struct HingeAngle {
  V angle;
  Vector3<V> g0, g1, g2, g3;
  V valid;  ///< 1, or 0 where the hinge is degenerate
};

/// Shares the apex gradients g2 and g3 among the edge's ends so that the gradient moves neither position nor direction.
template <class Math, class V = typename Math::V>
HWY_INLINE void balance_edge_ends(Vector3<V> e, Vector3<V> a, Vector3<V> b, V inverse_length2,
                                  HingeAngle<V>& hinge) {
  const V ta = dot<Math>(a, e) * inverse_length2, tb = dot<Math>(b, e) * inverse_length2;
  const V one = Math::number(1), zero = Math::number(0);
  hinge.g0 = scaled(ta - one, hinge.g2) + scaled(tb - one, hinge.g3);
  hinge.g1 = scaled(zero - ta, hinge.g2) + scaled(zero - tb, hinge.g3);
}

/// θ = atan2((n1 × n2)·e/|e|, n1·n2) with e = x1 - x0, n1 = e × (x2 - x0), n2 = (x3 - x0) × e: 0 when flat, defined up
/// to ±π (Bridson, Marino, Fedkiw 2003; gradients by differentiation).
template <class Math, class V = typename Math::V>
HWY_INLINE HingeAngle<V> hinge_angle(Vector3<V> x0, Vector3<V> x1, Vector3<V> x2,
                                     Vector3<V> x3) {
  const Vector3<V> e = x1 - x0, a = x2 - x0, b = x3 - x0;
  const Vector3<V> n1 = cross(e, a), n2 = cross(b, e);
  const V length2 = dot<Math>(e, e), n1_squared = dot<Math>(n1, n1), n2_squared = dot<Math>(n2, n2);
  // A triangle thinner than a ten-thousandth of its edge has no usable normal.
  const V zero = Math::number(0), one = Math::number(1),
          floor = Math::number(1e-8) * length2 * length2 + Math::number(1e-30);
  const V smaller = Math::min(n1_squared, n2_squared);
  HingeAngle<V> hinge;
  hinge.valid = Math::if_less(smaller, floor, zero, one);
  const V inverse_length = hinge.valid * Math::inverse_sqrt(Math::max(length2, Math::number(1e-30)));
  const V length = length2 * inverse_length;
  hinge.angle = hinge.valid * atan2<Math>(dot<Math>(cross(n1, n2), e) * inverse_length, dot<Math>(n1, n2));
  hinge.g2 = scaled(zero - length * Math::reciprocal(Math::max(n1_squared, floor)), n1);
  hinge.g3 = scaled(zero - length * Math::reciprocal(Math::max(n2_squared, floor)), n2);
  balance_edge_ends<Math>(e, a, b, inverse_length * inverse_length, hinge);
  return hinge;
}

/// The published variant: θ = arccos(n1·n2) of unit normals, without sign; its gradient has the factor 1/√(1 -
/// (n1·n2)²) that is lost near flat and folded hinges, which are therefore skipped (Müller et al. 2007, appendix A).
template <class Math, class V = typename Math::V>
HWY_INLINE HingeAngle<V> hinge_angle_arccos(Vector3<V> x0, Vector3<V> x1, Vector3<V> x2,
                                            Vector3<V> x3) {
  HingeAngle<V> hinge = hinge_angle<Math>(x0, x1, x2, x3);
  const V zero = Math::number(0);
  const V cosine_lost = Math::number(1e-3);  // below this angle float's 1 - cos θ has no digits left
  const V unsigned_angle = Math::abs(hinge.angle);
  const V distance_to_flat = Math::min(unsigned_angle, Math::number(3.14159265358979323846) - unsigned_angle);
  hinge.valid = Math::if_less(distance_to_flat, cosine_lost, zero, hinge.valid);
  const V sign = Math::copy_sign(hinge.valid, hinge.angle);
  hinge.angle = unsigned_angle;
  hinge.g0 = scaled(sign, hinge.g0), hinge.g1 = scaled(sign, hinge.g1);
  hinge.g2 = scaled(sign, hinge.g2), hinge.g3 = scaled(sign, hinge.g3);
  return hinge;
}

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
