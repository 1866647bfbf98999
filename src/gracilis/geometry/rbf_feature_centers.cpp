#include <gracilis/geometry/rbf_feature_centers.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

/// The centers that features of a height field suggest.
namespace gracilis {

namespace {

/// The eight nodes around one, in a ring.
constexpr std::array<std::array<int, 2>, 8> ring = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// Calls act(i, j) for all nodes at least `border` away from the border.
template <class Act>
void for_inner_nodes(const HeightField& field, Index border, const Act& act) {
  for (Index j = border; j < field.rows - border; ++j)
    for (Index i = border; i < field.columns - border; ++i) act(i, j);
}

Points where(const HeightField& field, const std::vector<char>& marked) {
  Points points(3, std::count(marked.begin(), marked.end(), 1));
  Index n = 0;
  for (Index j = 0; j < field.rows; ++j)
    for (Index i = 0; i < field.columns; ++i)
      if (marked[static_cast<std::size_t>(j * field.columns + i)]) points.col(n++) = field.node(i, j);
  return points;
}

std::vector<char> unmarked(const HeightField& field) {
  return std::vector<char>(static_cast<std::size_t>(field.heights.size()), 0);
}

/// How often the ring around a node changes between above and below it: 0 around extrema, 2 on slopes, more on saddles.
int changes_around(const HeightField& field, Index i, Index j) {
  int changes = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const auto& a = ring[k];
    const auto& b = ring[(k + 1) % ring.size()];
    changes += (field.at(i + a[0], j + a[1]) > field.at(i, j)) != (field.at(i + b[0], j + b[1]) > field.at(i, j));
  }
  return changes;
}

/// Half the Laplacian at every inner node, by central differences; 0 on the border.
HeightField curvature_of(const HeightField& field) {
  HeightField curvature = field;
  curvature.heights.setZero();
  for_inner_nodes(field, 1, [&](Index i, Index j) {
    const Real around = field.at(i + 1, j) + field.at(i - 1, j) + field.at(i, j + 1) + field.at(i, j - 1);
    curvature.heights[j * field.columns + i] = (around - 4 * field.at(i, j)) / (2 * field.step * field.step);
  });
  return curvature;
}

/// Below this a field's curvatures are rounding, by which planes would have some of both signs: that share of its
/// largest, or what the heights' last digits make of it.
Real least_curvature(const HeightField& field, const HeightField& curvature, Real share) {
  const Real digits = 8 * std::numeric_limits<Real>::epsilon() * field.heights.cwiseAbs().maxCoeff();
  return std::max(share * curvature.heights.cwiseAbs().maxCoeff(), digits / (field.step * field.step));
}

/// Slopes by central differences, at inner nodes.
Eigen::Vector2d slope_at(const HeightField& field, Index i, Index j) {
  return Eigen::Vector2d(field.at(i + 1, j) - field.at(i - 1, j), field.at(i, j + 1) - field.at(i, j - 1)) /
         (2 * field.step);
}

}  // namespace

Points HeightField::nodes() const {
  Points points(3, heights.size());
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) points.col(j * columns + i) = node(i, j);
  return points;
}

Eigen::AlignedBox3d HeightField::box() const { return {Vec3::Zero(), node(columns - 1, rows - 1)}; }

Points extremum_centers(const HeightField& field) {
  std::vector<char> marked = unmarked(field);
  for_inner_nodes(field, 1, [&](Index i, Index j) {
    const bool is_flat = std::any_of(ring.begin(), ring.end(), [&](const auto& step) {
      return field.at(i + step[0], j + step[1]) == field.at(i, j);
    });
    marked[static_cast<std::size_t>(j * field.columns + i)] = !is_flat && changes_around(field, i, j) == 0;
  });
  return where(field, marked);
}

Points inflection_centers(const HeightField& field) {
  const HeightField curvature = curvature_of(field);
  const Real least = least_curvature(field, curvature, 1e-9);
  std::vector<char> marked = unmarked(field);
  for_inner_nodes(field, 2, [&](Index i, Index j) {
    for (const auto& [a, b] : {std::array{1, 0}, std::array{0, 1}}) {
      const Real before = curvature.at(i - a, j - b), after = curvature.at(i + a, j + b);
      const Real smaller = std::min(std::abs(before), std::abs(after));
      if (before * after < 0 && smaller > least && std::abs(curvature.at(i, j)) <= smaller)
        marked[static_cast<std::size_t>(j * field.columns + i)] = 1;
    }
  });
  return where(field, marked);
}

Points curvature_centers(const HeightField& field) {
  const HeightField curvature = curvature_of(field);
  const Real least = least_curvature(field, curvature, 1e-6);
  std::vector<char> marked = unmarked(field);
  for_inner_nodes(field, 2, [&](Index i, Index j) {
    marked[static_cast<std::size_t>(j * field.columns + i)] =
        std::abs(curvature.at(i, j)) > least && changes_around(curvature, i, j) != 2;
  });
  return where(field, marked);
}

Points edge_centers(const HeightField& field, Real low, Real high) {
  Eigen::VectorXd steepness = Eigen::VectorXd::Zero(field.heights.size());
  const auto number = [&](Index i, Index j) { return j * field.columns + i; };
  for_inner_nodes(field, 1, [&](Index i, Index j) { steepness[number(i, j)] = slope_at(field, i, j).norm(); });
  const Real steepest = steepness.maxCoeff();
  std::vector<char> on_edge = unmarked(field), marked = on_edge;
  std::vector<std::array<Index, 2>> open;
  for_inner_nodes(field, 2, [&](Index i, Index j) {
    const Real here = steepness[number(i, j)];
    if (!(here > low * steepest)) return;
    // The step of the ring that goes most nearly across the edge.
    const Eigen::Vector2d across = slope_at(field, i, j);
    const auto octant = static_cast<std::size_t>(std::lround(std::atan2(across.y(), across.x()) / (pi / 4)) + 8) % 8;
    const auto& step = ring[octant];
    if (here < steepness[number(i + step[0], j + step[1])] || here < steepness[number(i - step[0], j - step[1])])
      return;
    on_edge[static_cast<std::size_t>(number(i, j))] = 1;
    if (here > high * steepest) open.push_back({i, j});
  });
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    char& mark = marked[static_cast<std::size_t>(number(i, j))];
    if (mark || !on_edge[static_cast<std::size_t>(number(i, j))]) continue;
    mark = 1;
    for (const auto& step : ring) open.push_back({i + step[0], j + step[1]});
  }
  return where(field, marked);
}

Points border_centers(const HeightField& field, Index between) {
  const Vec3 far = field.node(field.columns - 1, field.rows - 1);
  const std::array<Vec3, 4> corners = {Vec3::Zero(), Vec3(far.x(), 0, 0), far, Vec3(0, far.y(), 0)};
  Points centers(3, 4 * (between + 1));
  for (Index side = 0; side < 4; ++side)
    for (Index k = 0; k <= between; ++k) {
      const Real share = static_cast<Real>(k) / (between + 1);
      centers.col(side * (between + 1) + k) = (1 - share) * corners[static_cast<std::size_t>(side)] +
                                              share * corners[static_cast<std::size_t>((side + 1) % 4)];
    }
  return centers;
}

}  // namespace gracilis
