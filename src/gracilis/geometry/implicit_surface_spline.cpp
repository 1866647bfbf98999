#include <gracilis/geometry/implicit_surface_spline.hpp>
#include <gracilis/geometry/point_triangle.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <memory>
#include <utility>

namespace gracilis {

namespace {

constexpr Real smallest_radius = 0.0005;

ThickPoint blend(const std::array<Real, 4>& weights, const std::array<const ThickPoint*, 4>& points) {
  ThickPoint result;
  for (int i = 0; i < 4; ++i) {
    result.point += weights[i] * points[i]->point;
    result.radius += weights[i] * points[i]->radius;
  }
  result.radius = std::max(result.radius, smallest_radius);
  return result;
}

std::array<Real, 4> catmull_rom_weights(Real t) {
  return {t * (-1 + t * (2 - t)) / 2, (2 + t * t * (-5 + 3 * t)) / 2, t * (1 + t * (4 - 3 * t)) / 2,
          t * t * (t - 1) / 2};
}

}  // namespace

std::vector<ThickPoint> spline_through(const std::vector<ThickPoint>& points, int pieces) {
  assert(!points.empty() && pieces >= 1);
  if (points.size() == 1) return points;
  const auto beyond = [](const ThickPoint& end, const ThickPoint& next) {
    return ThickPoint{2 * end.point - next.point, 2 * end.radius - next.radius};
  };
  const ThickPoint before = beyond(points[0], points[1]);
  const ThickPoint after = beyond(points.back(), points[points.size() - 2]);

  std::vector<ThickPoint> result;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const std::array<const ThickPoint*, 4> around = {i == 0 ? &before : &points[i - 1], &points[i], &points[i + 1],
                                                     i + 2 < points.size() ? &points[i + 2] : &after};
    for (int k = 0; k < pieces; ++k) result.push_back(blend(catmull_rom_weights(Real(k) / pieces), around));
  }
  result.push_back(points.back());
  return result;
}

ThickSheet::ThickSheet(const ThickNet& net, int pieces) {
  assert(net.rows >= 2 && net.columns >= 2 && static_cast<int>(net.points.size()) == net.rows * net.columns);
  // Splines along each row first, then down through the results.
  std::vector<std::vector<ThickPoint>> cut_rows;
  for (int row = 0; row < net.rows; ++row) {
    const auto first = net.points.begin() + row * net.columns;
    cut_rows.push_back(spline_through({first, first + net.columns}, pieces));
  }
  columns_ = static_cast<int>(cut_rows[0].size());
  rows_ = (net.rows - 1) * pieces + 1;
  points_.resize(static_cast<std::size_t>(rows_) * columns_);
  for (int column = 0; column < columns_; ++column) {
    std::vector<ThickPoint> down;
    for (const auto& row : cut_rows) down.push_back(row[column]);
    down = spline_through(down, pieces);
    for (int row = 0; row < rows_; ++row) points_[row * columns_ + column] = down[row];
  }

  for (const ThickPoint& p : points_) {
    bounds_.extend(p.point - Vec3::Constant(p.radius));
    bounds_.extend(p.point + Vec3::Constant(p.radius));
  }
  for (int patch_row = 0; patch_row + 1 < rows_; patch_row += pieces)
    for (int patch_column = 0; patch_column + 1 < columns_; patch_column += pieces) {
      Patch patch;
      std::vector<int> all;
      for (int row = patch_row; row < patch_row + pieces; ++row)
        for (int column = patch_column; column < patch_column + pieces; ++column) {
          const int a = row * columns_ + column;
          const std::array<int, 4> corners = {a, a + 1, a + columns_, a + columns_ + 1};
          patch.quads.push_back({corners, reach_of({corners.begin(), corners.end()})});
          all.insert(all.end(), corners.begin(), corners.end());
        }
      patch.reach = reach_of(all);
      patches_.push_back(std::move(patch));
    }
}

ThickSheet::Reach ThickSheet::reach_of(const std::vector<int>& points) const {
  Reach reach;
  for (int p : points) reach.center += points_[p].point / static_cast<Real>(points.size());
  for (int p : points)
    reach.radius = std::max(reach.radius, (points_[p].point - reach.center).norm() + points_[p].radius);
  return reach;
}

void ThickSheet::search(const Patch& patch, const Vec3& point, Nearest& best) const {
  for (const Quad& quad : patch.quads) {
    if (quad.reach.least_distance(point) >= best.distance) continue;
    for (int half = 0; half < 2; ++half) {
      const std::array<int, 3> corners = {quad.corners[half == 0 ? 0 : 2], quad.corners[1],
                                          quad.corners[half == 0 ? 2 : 3]};
      const ThickPoint &a = points_[corners[0]], &b = points_[corners[1]], &c = points_[corners[2]];
      const Vec3 l = nearest_barycentric(point, a.point, b.point, c.point);
      const Vec3 offset = point - l[0] * a.point - l[1] * b.point - l[2] * c.point;
      const Real distance = offset.norm() - l[0] * a.radius - l[1] * b.radius - l[2] * c.radius;
      if (distance >= best.distance) continue;
      best = {distance, 0, 0};
      for (int i = 0; i < 3; ++i) {
        const int row = corners[i] / columns_, column = corners[i] % columns_;
        best.along += l[i] * row / (rows_ - 1);
        best.across += l[i] * column / (columns_ - 1);
      }
    }
  }
}

ThickSheet::Nearest ThickSheet::nearest(const Vec3& point) const {
  // The patch that could be nearest goes first, so that most others need not be looked into.
  const Patch* first = nullptr;
  Real least = std::numeric_limits<Real>::max();
  for (const Patch& patch : patches_) {
    const Real bound = patch.reach.least_distance(point);
    if (bound < least) first = &patch, least = bound;
  }
  Nearest best;
  best.distance = std::numeric_limits<Real>::max();
  search(*first, point, best);
  for (const Patch& patch : patches_)
    if (&patch != first && patch.reach.least_distance(point) < best.distance) search(patch, point, best);
  return best;
}

ImplicitSolid thick_sheet(const ThickNet& net) {
  auto sheet = std::make_shared<const ThickSheet>(net);
  const Eigen::AlignedBox3d bounds = sheet->bounds();
  return {[sheet, bounds](const Vec3& point) {
            const Real to_bounds = bounds.exteriorDistance(point);
            return to_bounds > far_distance ? to_bounds : sheet->nearest(point).distance;
          },
          bounds};
}

}  // namespace gracilis
