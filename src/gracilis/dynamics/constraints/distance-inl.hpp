// The length of an edge and its gradient, for any number type. Included once per instruction set, hence the guard that
// flips with each of Highway's passes; a plain include (tests) uses the baseline.

#if defined(GRACILIS_DISTANCE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRACILIS_DISTANCE_INL
#undef GRACILIS_DISTANCE_INL
#else
#define GRACILIS_DISTANCE_INL
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

}  // namespace gracilis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
