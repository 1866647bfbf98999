#include <gracilis/geometry/section_map.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/isocontours.hpp>
#include <gracilis/geometry/sparse_ldlt.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace gracilis {

using Vec2 = Eigen::Vector2d;

namespace {

/// A plane with its own axes; the line runs counter-clockwise in it.
struct Plane {
  Vec3 center, x, y, normal;

  explicit Plane(const Points& loop) : center(loop.rowwise().mean()), normal(Vec3::Zero()) {
    for (Eigen::Index i = 0, j = loop.cols() - 1; i < loop.cols(); j = i++)
      normal += (loop.col(j) - center).cross(loop.col(i) - center);
    normal.normalize();
    x = normal.unitOrthogonal();
    y = normal.cross(x);
  }
  PlanePoints flat(const Points& points) const {
    Eigen::Matrix<Real, 2, 3> axes;
    axes << x.transpose(), y.transpose();
    return axes * (points.colwise() - center);
  }
};

/// Where the share `at` of the line's length lies on the square's boundary.
Vec2 on_square(Real at, const SquareCorners& corners) {
  static const std::array<Vec2, 5> square = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1), Vec2(0, 0)};
  while (at < corners[0]) at += 1;
  while (at >= corners[0] + 1) at -= 1;
  for (std::size_t side = 0; side < 4; ++side) {
    const Real begin = corners[side], end = side < 3 ? corners[side + 1] : corners[0] + 1;
    if (at > end) continue;
    const Real share = end > begin ? (at - begin) / (end - begin) : 0;
    return square[side] + share * (square[side + 1] - square[side]);
  }
  return square[0];
}

/// A triangular lattice inside the polygon, clear of its sides.
std::vector<Vec2> lattice_inside(const PlanePoints& polygon, Real spacing) {
  std::vector<Vec2> inside;
  const Vec2 low = polygon.rowwise().minCoeff(), high = polygon.rowwise().maxCoeff();
  const Real row_height = spacing * std::sqrt(Real{3}) / 2;
  bool odd = false;
  for (Real y = low.y() + row_height / 2; y < high.y(); y += row_height, odd = !odd)
    for (Real x = low.x() + (odd ? spacing / 2 : 0); x < high.x(); x += spacing) {
      const Vec2 p(x, y);
      if (inside_polygon(polygon, p) && distance_to_polygon(polygon, p) > spacing / 2) inside.push_back(p);
    }
  return inside;
}

/// Values of harmonic functions (one per column) at all points when the first `given.rows()` points have these.
/// Cotangent weights of the triangulation, kept positive.
Eigen::MatrixXd harmonic_inside(const PlanePoints& points, const Eigen::Matrix3Xi& triangles,
                                const Eigen::MatrixXd& given) {
  const auto boundary = static_cast<Index>(given.rows()), unknown = static_cast<Index>(points.cols()) - boundary;
  Eigen::MatrixXd values(points.cols(), given.cols());
  values.topRows(boundary) = given;
  if (unknown == 0) return values;
  std::vector<Eigen::Triplet<Real>> entries;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(unknown, given.cols());
  for (Index t = 0; t < triangles.cols(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Index a = triangles(k, t), b = triangles((k + 1) % 3, t), c = triangles((k + 2) % 3, t);
      const Vec2 u = points.col(a) - points.col(c), v = points.col(b) - points.col(c);
      const Real area = std::abs(u.x() * v.y() - u.y() * v.x());
      const Real weight = std::max(area > 0 ? u.dot(v) / area : 0, Real{1e-3});
      for (const auto& [i, j] : {std::pair{a, b}, std::pair{b, a}}) {
        if (i < boundary) continue;
        entries.emplace_back(i - boundary, i - boundary, weight);
        if (j >= boundary) {
          entries.emplace_back(i - boundary, j - boundary, -weight);
        } else {
          right.row(i - boundary) += weight * given.row(j);
        }
      }
    }
  }
  Eigen::SparseMatrix<Real> matrix(unknown, unknown);
  matrix.setFromTriplets(entries.begin(), entries.end());
  SparseLdlt factors;
  factors.factor(matrix,
                 "a cross-section's map has no solution: its outline has coordinates that are not finite, or far too "
                 "large or small");
  values.bottomRows(unknown) = factors.solve(right);
  return values;
}

}  // namespace

SquareCorners square_corners(const Points& loop, Real& aspect) {
  constexpr Index count = 256;
  const Points even = resampled_loop(loop, count);
  const Plane plane(even);
  const PlanePoints flat = plane.flat(even);
  const Real circumference = closed_length(loop), area = std::abs(polygon_area(flat));
  const Real quarter = circumference / 4;
  const Real thin = quarter - std::sqrt(std::max(quarter * quarter - area, Real{0}));
  aspect = thin > 0 ? (circumference / 2 - thin) / thin : 1;

  // The far ends along the principal direction: the middle of the points within 3 % of the extreme.
  const PlanePoints centered = flat.colwise() - flat.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> spread(centered * centered.transpose());
  const Eigen::RowVectorXd along = spread.eigenvectors().col(1).transpose() * centered;
  const Real extent = along.maxCoeff() - along.minCoeff();
  const auto tip = [&](Real sign) {
    const Real limit = (sign * along).maxCoeff() - 0.03 * extent;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();  // a mean of angles, since shares go around
    for (Index i = 0; i < count; ++i)
      if (sign * along[i] >= limit) sum += Eigen::Vector2d(std::cos(2 * pi * i / count), std::sin(2 * pi * i / count));
    const Real share = std::atan2(sum.y(), sum.x()) / (2 * pi);
    return share < 0 ? share + 1 : share;
  };
  Real first = tip(-1), second = tip(1);
  if (second < first) second += 1;
  // No side may vanish.
  const Real half = std::min({thin / circumference / 2, 0.45 * (second - first), 0.45 * (first + 1 - second)});
  return {first + half, second - half, second + half, first + 1 - half};
}

std::optional<SectionMap> SectionMap::build(const Points& loop, const SquareCorners& corners) {
  const Real circumference = closed_length(loop);
  if (loop.cols() < 3 || !(circumference > 0)) return std::nullopt;
  Points even = resampled_loop(loop, 64);
  Plane plane(even);
  if (!plane.normal.allFinite()) return std::nullopt;
  const Real area = polygon_area(plane.flat(even));
  if (!(area > 1e-4 * circumference * circumference) || !is_simple(plane.flat(even))) return std::nullopt;

  // Fine enough for four rows of triangles across a thin section, coarse enough to stay small.
  const Real spacing = std::max(std::min(std::sqrt(area / 120), area / circumference), std::sqrt(area / 500));
  const Index boundary = std::clamp(4 * static_cast<Index>(circumference / spacing / 4), 48, 240);
  even = resampled_loop(loop, boundary);
  const PlanePoints polygon = plane.flat(even);
  if (!is_simple(polygon)) return std::nullopt;
  const std::vector<Vec2> inside = lattice_inside(polygon, spacing);
  PlanePoints flat(2, boundary + static_cast<Index>(inside.size()));
  flat.leftCols(boundary) = polygon;
  for (std::size_t i = 0; i < inside.size(); ++i) flat.col(boundary + static_cast<Index>(i)) = inside[i];

  Eigen::Matrix3Xi triangles = delaunay(flat);
  Index kept = 0;
  for (Index t = 0; t < triangles.cols(); ++t) {
    const Vec2 middle = (flat.col(triangles(0, t)) + flat.col(triangles(1, t)) + flat.col(triangles(2, t))) / 3;
    if (inside_polygon(polygon, middle)) triangles.col(kept++) = triangles.col(t).eval();
  }
  if (kept == 0) return std::nullopt;
  triangles.conservativeResize(3, kept);

  Eigen::MatrixXd given(boundary, 3);  // a, b, height
  for (Index i = 0; i < boundary; ++i)
    given.row(i) << on_square(Real(i) / boundary, corners).transpose(), plane.normal.dot(even.col(i) - plane.center);
  const Eigen::MatrixXd values = harmonic_inside(flat, triangles, given);

  SectionMap map;
  map.triangles_ = std::move(triangles);
  map.square_ = values.leftCols(2).transpose();
  map.points_.resize(3, flat.cols());
  for (Index i = 0; i < flat.cols(); ++i)
    map.points_.col(i) = plane.center + flat(0, i) * plane.x + flat(1, i) * plane.y + values(i, 2) * plane.normal;
  return map;
}

Vec2 SectionMap::nearest(const Vec3& p) const {
  Index vertex = 0;
  (points_.colwise() - p).colwise().squaredNorm().minCoeff(&vertex);
  return square_.col(vertex);
}

Vec3 SectionMap::at(Real a, Real b) const {
  // The triangle in which (a, b) lies deepest: rounding may put it a trifle outside of all.
  const Vec2 p(a, b);
  Real deepest = -std::numeric_limits<Real>::infinity();
  Vec3 weights(1, 0, 0);
  Index found = 0;
  for (Index t = 0; t < triangles_.cols(); ++t) {
    Eigen::Matrix2d sides;
    sides << square_.col(triangles_(1, t)) - square_.col(triangles_(0, t)),
        square_.col(triangles_(2, t)) - square_.col(triangles_(0, t));
    const Real area = sides.determinant();
    if (!(std::abs(area) > 1e-14)) continue;
    const Vec2 share = sides.inverse() * (p - square_.col(triangles_(0, t)));
    const Vec3 here(1 - share.x() - share.y(), share.x(), share.y());
    if (here.minCoeff() <= deepest) continue;
    deepest = here.minCoeff();
    weights = here;
    found = t;
    if (deepest >= 0) break;
  }
  weights = weights.cwiseMax(0);
  weights /= weights.sum();
  return points_.col(triangles_(0, found)) * weights[0] + points_.col(triangles_(1, found)) * weights[1] +
         points_.col(triangles_(2, found)) * weights[2];
}

}  // namespace gracilis
