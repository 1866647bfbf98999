#include <gracilis/geometry/point_triangle.hpp>

#include <gracilis/geometry/point_segment.hpp>

namespace gracilis {

namespace {

template <class S>
using Vector3 = Eigen::Matrix<S, 3, 1>;

template <class S>
Vector3<S> nearest_on_boundary(const Vector3<S>& p, const Vector3<S>& a, const Vector3<S>& b, const Vector3<S>& c) {
  const S ab = nearest_on_segment(p, a, b), bc = nearest_on_segment(p, b, c), ca = nearest_on_segment(p, c, a);
  const Vector3<S> candidates[3] = {{1 - ab, ab, 0}, {0, 1 - bc, bc}, {ca, 0, 1 - ca}};
  const Vector3<S>* best = &candidates[0];
  S best_distance2 = (a + ab * (b - a) - p).squaredNorm();
  const auto consider = [&](const Vector3<S>& candidate, const Vector3<S>& point) {
    const S distance2 = (point - p).squaredNorm();
    if (distance2 < best_distance2) best = &candidate, best_distance2 = distance2;
  };
  consider(candidates[1], b + bc * (c - b));
  consider(candidates[2], c + ca * (a - c));
  return *best;
}

template <class S>
Vector3<S> nearest(const Vector3<S>& p, const Vector3<S>& a, const Vector3<S>& b, const Vector3<S>& c) {
  const Vector3<S> ab = b - a, ac = c - a, ap = p - a;
  const S d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};

  const Vector3<S> bp = p - b;
  const S d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};

  const Vector3<S> cp = p - c;
  const S d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};

  const S wc = d1 * d4 - d3 * d2, wb = d5 * d2 - d1 * d6, wa = d3 * d6 - d5 * d4;
  const S total = wa + wb + wc;
  const bool inside = wa > 0 && wb > 0 && wc > 0;
  if (!inside || !(total > 0)) return nearest_on_boundary<S>(p, a, b, c);
  return {wa / total, wb / total, wc / total};
}

}  // namespace

Vec3 nearest_barycentric(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  return nearest<Real>(p, a, b, c);
}

Eigen::Vector3f nearest_barycentric(const Eigen::Vector3f& p, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                    const Eigen::Vector3f& c) {
  return nearest<float>(p, a, b, c);
}

}  // namespace gracilis
