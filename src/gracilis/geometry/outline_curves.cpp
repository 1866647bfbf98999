#include <gracilis/geometry/outline_curves.hpp>

#include <gracilis/geometry/delaunay.hpp>
#include <gracilis/geometry/principal_axes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace gracilis {

namespace {

using Edge = std::pair<Index, Index>;
using Edges = std::set<Edge>;

Edge edge_of(Index a, Index b) { return std::minmax(a, b); }

Real distance(const Points& points, Index a, Index b) { return (points.col(a) - points.col(b)).norm(); }

/// The points seen along the normal of the plane that fits them best.
PlanePoints flattened(const Points& points) {
  const Points centered = points.colwise() - points.rowwise().mean();
  return spread_of(points).directions.rightCols(2).transpose() * centered;
}

std::vector<Index> nearest_chain(const Points& points) {
  const auto n = static_cast<Index>(points.cols());
  std::vector<Index> order = {0};
  std::vector<char> taken(static_cast<std::size_t>(n), 0);
  taken[0] = 1;
  while (static_cast<Index>(order.size()) < n) {
    Index next = -1;
    for (Index i = 0; i < n; ++i)
      if (!taken[static_cast<std::size_t>(i)] &&
          (next < 0 || distance(points, order.back(), i) < distance(points, order.back(), next)))
        next = i;
    taken[static_cast<std::size_t>(next)] = 1;
    order.push_back(next);
  }
  return order;
}

Edges nn_crust(const Points& points) {
  Edges edges;
  const auto n = static_cast<Index>(points.cols());
  for (Index p = 0; p < n; ++p) {
    const auto nearest = [&](const auto& counts) {
      Index best = -1;
      for (Index q = 0; q < n; ++q)
        if (q != p && counts(q) && (best < 0 || distance(points, p, q) < distance(points, p, best))) best = q;
      return best;
    };
    const Index first = nearest([](Index) { return true; });
    edges.insert(edge_of(p, first));
    const Vec3 way = points.col(first) - points.col(p);
    const Index other = nearest([&](Index q) { return way.dot(points.col(q) - points.col(p)) < 0; });
    if (other >= 0) edges.insert(edge_of(p, other));
  }
  return edges;
}

struct Circle {
  Eigen::Vector2d center;
  Real radius = 0;
};

Circle circumcircle(const PlanePoints& points, const Eigen::Vector3i& corners) {
  const Eigen::Vector2d a = points.col(corners[0]), b = points.col(corners[1]) - a, c = points.col(corners[2]) - a;
  const Real twice = 2 * (b.x() * c.y() - b.y() * c.x());
  const Eigen::Vector2d way(c.y() * b.squaredNorm() - b.y() * c.squaredNorm(),
                            b.x() * c.squaredNorm() - c.x() * b.squaredNorm());
  return {a + way / twice, way.norm() / std::abs(twice)};
}

Edges crust(const PlanePoints& points) {
  const auto n = static_cast<Index>(points.cols());
  const Eigen::Matrix3Xi triangles = delaunay(points);
  PlanePoints all(2, n + triangles.cols());
  all.leftCols(n) = points;
  Index count = n;
  // Far away circumcenters of slivers separate nothing and would spoil the triangulation's numbers.
  const Real farthest = 10 * points.colwise().norm().maxCoeff();
  for (Index t = 0; t < static_cast<Index>(triangles.cols()); ++t) {
    const Circle circle = circumcircle(points, triangles.col(t));
    if (circle.center.allFinite() && circle.center.norm() < farthest) all.col(count++) = circle.center;
  }
  Edges edges;
  const Eigen::Matrix3Xi with_voronoi = delaunay(all.leftCols(count));
  for (Index t = 0; t < static_cast<Index>(with_voronoi.cols()); ++t)
    for (int k = 0; k < 3; ++k) {
      const Index a = with_voronoi(k, t), b = with_voronoi((k + 1) % 3, t);
      if (a < n && b < n) edges.insert(edge_of(a, b));
    }
  return edges;
}

/// Edges that no point sees under an angle above asin(1 / β).
Edges beta_skeleton(const Points& points) {
  constexpr Real beta = 1.2;
  const Real least_cosine = std::sqrt(1 - 1 / (beta * beta));
  Edges edges;
  const auto n = static_cast<Index>(points.cols());
  for (Index p = 0; p < n; ++p)
    for (Index q = p + 1; q < n; ++q) {
      bool is_free = true;
      for (Index r = 0; r < n && is_free; ++r) {
        if (r == p || r == q) continue;
        const Vec3 a = points.col(p) - points.col(r), b = points.col(q) - points.col(r);
        is_free = a.dot(b) > least_cosine * a.norm() * b.norm();
      }
      if (is_free) edges.insert({p, q});
    }
  return edges;
}

/// Edges with one triangle on them, for the smallest disk with which triangles touch all points.
Edges alpha_shape(const PlanePoints& points) {
  const Eigen::Matrix3Xi triangles = delaunay(points);
  const auto count = static_cast<Index>(triangles.cols());
  std::vector<std::pair<Real, Index>> by_radius;
  for (Index t = 0; t < count; ++t) by_radius.emplace_back(circumcircle(points, triangles.col(t)).radius, t);
  std::sort(by_radius.begin(), by_radius.end());
  std::vector<char> touched(static_cast<std::size_t>(points.cols()), 0);
  Index untouched = static_cast<Index>(points.cols());
  std::multiset<Edge> all;
  for (const auto& [radius, t] : by_radius) {
    if (untouched == 0) break;
    for (int k = 0; k < 3; ++k) {
      const Index a = triangles(k, t);
      char& mark = touched[static_cast<std::size_t>(a)];
      untouched -= !mark;
      mark = 1;
      all.insert(edge_of(a, triangles((k + 1) % 3, t)));
    }
  }
  Edges edges;
  for (const Edge& edge : all)
    if (all.count(edge) == 1) edges.insert(edge);
  return edges;
}

Edges spanning_tree(const Points& points) {
  const auto n = static_cast<Index>(points.cols());
  Edges edges;
  std::vector<Index> from(static_cast<std::size_t>(n), 0);
  std::vector<char> in_tree(static_cast<std::size_t>(n), 0);
  in_tree[0] = 1;
  for (Index i = 1; i < n; ++i) {
    Index next = -1;
    Real least = std::numeric_limits<Real>::infinity();
    for (Index q = 0; q < n; ++q)
      if (const auto at = static_cast<std::size_t>(q); !in_tree[at] && distance(points, from[at], q) < least)
        least = distance(points, from[at], q), next = q;
    in_tree[static_cast<std::size_t>(next)] = 1;
    edges.insert(edge_of(from[static_cast<std::size_t>(next)], next));
    for (Index q = 0; q < n; ++q)
      if (Index& nearest = from[static_cast<std::size_t>(q)]; distance(points, next, q) < distance(points, nearest, q))
        nearest = next;
  }
  return edges;
}

/// A closed way of the shortest of the given edges, two at each point at most; then of the shortest links between the
/// ends that are left.
std::vector<Index> closed_way(const Points& points, const Edges& given) {
  const auto n = static_cast<Index>(points.cols());
  std::vector<std::vector<Index>> beside(static_cast<std::size_t>(n));
  std::vector<Index> chain(static_cast<std::size_t>(n));
  std::iota(chain.begin(), chain.end(), 0);
  Index joined = 0;
  const auto take_shortest = [&](std::vector<Edge> edges) {
    std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) {
      return std::pair(distance(points, a.first, a.second), a) < std::pair(distance(points, b.first, b.second), b);
    });
    for (const auto& [a, b] : edges) {
      auto &at_a = beside[static_cast<std::size_t>(a)], &at_b = beside[static_cast<std::size_t>(b)];
      const Index of_a = chain[static_cast<std::size_t>(a)], of_b = chain[static_cast<std::size_t>(b)];
      if (at_a.size() > 1 || at_b.size() > 1 || of_a == of_b) continue;
      at_a.push_back(b), at_b.push_back(a);
      std::replace(chain.begin(), chain.end(), of_b, of_a);
      ++joined;
    }
  };
  take_shortest({given.begin(), given.end()});
  std::vector<Edge> all;
  for (Index a = 0; a < n; ++a)
    for (Index b = a + 1; b < n; ++b) all.emplace_back(a, b);
  if (joined < n - 1) take_shortest(std::move(all));
  // One chain now: along it from one end.
  Index at = 0;
  while (beside[static_cast<std::size_t>(at)].size() > 1) ++at;
  std::vector<Index> order;
  for (Index last = -1; static_cast<Index>(order.size()) < n;) {
    order.push_back(at);
    Index next = -1;
    for (const Index other : beside[static_cast<std::size_t>(at)])
      if (other != last) next = other;
    last = at, at = next;
  }
  return order;
}

/// Turns parts of a closed way around, and moves single points, as long as that makes it shorter.
std::vector<Index> shortened(const Points& points, std::vector<Index> order) {
  const auto n = order.size();
  const auto length = [&](std::size_t i, std::size_t j) { return distance(points, order[i % n], order[j % n]); };
  constexpr Real worth = 1e-12;
  for (bool is_better = true; is_better;) {
    is_better = false;
    for (std::size_t i = 0; i + 2 < n; ++i)
      for (std::size_t j = i + 2; j < n; ++j) {
        if (length(i, j) + length(i + 1, j + 1) + worth >= length(i, i + 1) + length(j, j + 1)) continue;
        std::reverse(order.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                     order.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        is_better = true;
      }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        if (j == i || (j + 1) % n == i) continue;
        const Real gain = length(i + n - 1, i) + length(i, i + 1) - length(i + n - 1, i + 1);
        const Real price = length(j, i) + length(i, j + 1) - length(j, j + 1);
        if (price + worth >= gain) continue;
        const Index moved = order[i], after = order[j];
        order.erase(order.begin() + static_cast<std::ptrdiff_t>(i));
        order.insert(std::find(order.begin(), order.end(), after) + 1, moved);
        is_better = true;
      }
  }
  return order;
}

std::vector<Index> by_angle(const PlanePoints& points) {
  std::vector<Index> order(static_cast<std::size_t>(points.cols()));
  std::iota(order.begin(), order.end(), 0);
  const auto angle = [&](Index i) { return std::atan2(points(1, i), points(0, i)); };
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return angle(a) < angle(b); });
  return order;
}

}  // namespace

std::vector<Index> outline_order(OutlineCurve curve, const Points& points) {
  std::vector<Index> order(static_cast<std::size_t>(points.cols()));
  std::iota(order.begin(), order.end(), 0);
  if (points.cols() < 4) return order;
  switch (curve) {
    case OutlineCurve::nearest_neighbor:
      return nearest_chain(points);
    case OutlineCurve::nn_crust:
      return closed_way(points, nn_crust(points));
    case OutlineCurve::crust:
      return closed_way(points, crust(flattened(points)));
    case OutlineCurve::beta_skeleton:
      return closed_way(points, beta_skeleton(points));
    case OutlineCurve::alpha_shape:
      return closed_way(points, alpha_shape(flattened(points)));
    case OutlineCurve::spanning_tree:
      return closed_way(points, spanning_tree(points));
    case OutlineCurve::shortest_tour:
      return shortened(points, nearest_chain(points));
    case OutlineCurve::angular:
      return by_angle(flattened(points));
  }
  return order;
}

Points ordered_outline(OutlineCurve curve, const Points& points) {
  const std::vector<Index> order = outline_order(curve, points);
  Points ordered(3, points.cols());
  for (std::size_t i = 0; i < order.size(); ++i) ordered.col(static_cast<Index>(i)) = points.col(order[i]);
  return ordered;
}

}  // namespace gracilis
