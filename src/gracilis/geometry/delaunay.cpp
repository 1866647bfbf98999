#include <gracilis/geometry/delaunay.hpp>

#include <gracilis/geometry/point_segment.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace gracilis {

using Vec2 = Eigen::Vector2d;

static Real cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Twice the signed area of the triangle.
static Real turn(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

/// Positive when p lies inside the circle through a, b and c, which are counter-clockwise.
static Real in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p) {
  const Vec2 u = a - p, v = b - p, w = c - p;
  return u.squaredNorm() * cross(v, w) - v.squaredNorm() * cross(u, w) + w.squaredNorm() * cross(u, v);
}

Eigen::Matrix3Xi delaunay(const PlanePoints& points) {
  const auto n = static_cast<Index>(points.cols());
  // A triangle around everything, taken away at the end.
  const Vec2 low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
  const Vec2 middle = (low + high) / 2;
  const Real reach = 100 * std::max((high - low).maxCoeff(), Real{1e-12});
  PlanePoints all(2, n + 3);
  all << points, middle + Vec2(-reach, -reach), middle + Vec2(reach, -reach), middle + Vec2(0, reach);

  std::vector<std::array<Index, 3>> triangles = {{n, n + 1, n + 2}};
  for (Index i = 0; i < n; ++i) {
    // Triangles whose circle holds the new point make way for a fan around it.
    std::vector<std::array<Index, 2>> rim;
    std::vector<std::array<Index, 3>> kept;
    bool repeated = false;
    for (const auto& t : triangles) {
      for (const Index corner : t) repeated |= all.col(corner) == all.col(i);
      if (in_circle(all.col(t[0]), all.col(t[1]), all.col(t[2]), all.col(i)) > 0) {
        for (std::size_t k = 0; k < 3; ++k) rim.push_back({t[k], t[(k + 1) % 3]});
      } else {
        kept.push_back(t);
      }
    }
    if (repeated) continue;
    for (const auto& side : rim) {
      const bool inner = std::find(rim.begin(), rim.end(), std::array<Index, 2>{side[1], side[0]}) != rim.end();
      if (!inner && turn(all.col(side[0]), all.col(side[1]), all.col(i)) > 0) kept.push_back({side[0], side[1], i});
    }
    triangles = std::move(kept);
  }
  std::erase_if(triangles, [&](const auto& t) { return std::max({t[0], t[1], t[2]}) >= n; });
  Eigen::Matrix3Xi faces(3, static_cast<Index>(triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    faces.col(static_cast<Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  return faces;
}

bool inside_polygon(const PlanePoints& polygon, const Vec2& p) {
  bool inside = false;
  for (Eigen::Index i = 0, j = polygon.cols() - 1; i < polygon.cols(); j = i++) {
    const Vec2 a = polygon.col(i), b = polygon.col(j);
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

Real polygon_area(const PlanePoints& polygon) {
  Real twice = 0;
  for (Eigen::Index i = 0, j = polygon.cols() - 1; i < polygon.cols(); j = i++)
    twice += cross(polygon.col(j) - polygon.col(0), polygon.col(i) - polygon.col(0));
  return twice / 2;
}

bool is_simple(const PlanePoints& polygon) {
  const Eigen::Index n = polygon.cols();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec2 a = polygon.col(i), b = polygon.col((i + 1) % n);
    for (Eigen::Index j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      const Vec2 c = polygon.col(j), d = polygon.col((j + 1) % n);
      if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) return false;
    }
  }
  return true;
}

Real distance_to_polygon(const PlanePoints& polygon, const Vec2& p) {
  Real nearest = std::numeric_limits<Real>::infinity();
  for (Eigen::Index i = 0, j = polygon.cols() - 1; i < polygon.cols(); j = i++)
    nearest = std::min(nearest, distance_to_segment<Vec2>(p, polygon.col(j), polygon.col(i)));
  return nearest;
}

}  // namespace gracilis
