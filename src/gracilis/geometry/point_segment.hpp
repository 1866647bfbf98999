#pragma once

#include <Eigen/Core>

#include <algorithm>

namespace gracilis {

/// Parameter in [0, 1] of the point of segment (a, b) nearest to p: 0 at a, 1 at b; 0 when the segment has no length.
template <class P>
typename P::Scalar nearest_on_segment(const P& p, const P& a, const P& b) {
  using S = typename P::Scalar;
  const P along = b - a;
  const S length2 = along.squaredNorm();
  return length2 > 0 ? std::clamp((p - a).dot(along) / length2, S{0}, S{1}) : S{0};
}

/// How far p is from segment (a, b).
template <class P>
typename P::Scalar distance_to_segment(const P& p, const P& a, const P& b) {
  return (p - a - nearest_on_segment<P>(p, a, b) * (b - a)).norm();
}

}  // namespace gracilis
