#include <gracilis/geometry/point_triangle.hpp>

#include <algorithm>

namespace gracilis {

/// Parameter in [0, 1] of the point of segment (a, b) nearest to p; 0 when the segment has no length.
static Real nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const Real length2 = ab.squaredNorm();
  return length2 > 0 ? std::clamp((p - a).dot(ab) / length2, Real{0}, Real{1}) : Real{0};
}

static Vec3 nearest_on_boundary(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Real ab = nearest_on_segment(p, a, b), bc = nearest_on_segment(p, b, c), ca = nearest_on_segment(p, c, a);
  const Vec3 candidates[3] = {{1 - ab, ab, 0}, {0, 1 - bc, bc}, {ca, 0, 1 - ca}};
  const Vec3* best = &candidates[0];
  Real best_distance2 = (a + ab * (b - a) - p).squaredNorm();
  const auto consider = [&](const Vec3& candidate, const Vec3& point) {
    const Real distance2 = (point - p).squaredNorm();
    if (distance2 < best_distance2) best = &candidate, best_distance2 = distance2;
  };
  consider(candidates[1], b + bc * (c - b));
  consider(candidates[2], c + ca * (a - c));
  return *best;
}

Vec3 nearest_barycentric(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const Real d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};

  const Vec3 bp = p - b;
  const Real d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};

  const Vec3 cp = p - c;
  const Real d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};

  const Real wc = d1 * d4 - d3 * d2, wb = d5 * d2 - d1 * d6, wa = d3 * d6 - d5 * d4;
  const Real total = wa + wb + wc;
  const bool inside = wa > 0 && wb > 0 && wc > 0;
  if (!inside || !(total > 0)) return nearest_on_boundary(p, a, b, c);
  return {wa / total, wb / total, wc / total};
}

}  // namespace gracilis
