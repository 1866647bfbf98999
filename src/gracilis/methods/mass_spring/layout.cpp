#include <gracilis/methods/mass_spring/layout.hpp>

#include <gracilis/core/sort_unique.hpp>
#include <gracilis/geometry/delaunay_edges.hpp>
#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/geometry/principal_axes.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace gracilis::mass_spring {

namespace {

SpringPairs sorted(SpringPairs pairs) {
  for (std::array<Index, 2>& pair : pairs) std::sort(pair.begin(), pair.end());
  sort_unique(pairs);
  return pairs;
}

/// The middles of fibers in the plane across their mean direction, 2 × fibers: first along their widest spread.
Eigen::Matrix2Xd middles_across(const Polylines& particles) {
  Points middles(3, particles.count());
  Vec3 along = Vec3::Zero();
  for (Index f = 0; f < particles.count(); ++f) {
    middles.col(f) = particles.line(f).rowwise().mean();
    along += particles.points.col(particles.end(f) - 1) - particles.points.col(particles.begin(f));
  }
  middles.colwise() -= Vec3(middles.rowwise().mean());
  if (along.norm() > 0) middles -= along.normalized() * (along.normalized().transpose() * middles);
  const PrincipalAxes spread = principal_axes(middles * middles.transpose());
  Eigen::Matrix<Real, 2, 3> axes;
  axes.row(0) = spread.most().transpose();
  axes.row(1) = spread.directions.col(1).transpose();
  return axes * middles;
}

/// `order` sorted by a coordinate; where it is the same, by the number.
void sort_by(const Eigen::Matrix2Xd& points, int coordinate, std::vector<Index>& order) {
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    const Real first = points(coordinate, a), second = points(coordinate, b);
    return first < second || (first == second && a < b);
  });
}

/// The steps to a particle's neighbors in the lattice, one of each pair of opposite ones.
std::vector<std::array<int, 3>> lattice_steps(bool diagonals) {
  std::vector<std::array<int, 3>> steps;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -1; k <= 1; ++k) {
        const int moved = std::abs(i) + std::abs(j) + std::abs(k);
        const bool is_first_of_two = std::array{i, j, k} > std::array{0, 0, 0};
        if (is_first_of_two && (diagonals || moved == 1)) steps.push_back({i, j, k});
      }
  return steps;
}

}  // namespace

std::vector<std::vector<Index>> fiber_lattice(const Polylines& particles) {
  const Index count = particles.count();
  if (count == 0) return {};
  const Eigen::Matrix2Xd middles = middles_across(particles);
  std::vector<Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  sort_by(middles, 0, order);
  const auto columns = std::max(1, static_cast<int>(std::lround(std::sqrt(count))));
  std::vector<std::vector<Index>> lattice;
  for (int c = 0; c < columns; ++c) {
    std::vector<Index> column(order.begin() + count * c / columns, order.begin() + count * (c + 1) / columns);
    sort_by(middles, 1, column);
    lattice.push_back(std::move(column));
  }
  return lattice;
}

SpringPairs cubic_pairs(const Polylines& particles, bool diagonals) {
  const std::vector<std::vector<Index>> lattice = fiber_lattice(particles);
  const auto particle_at = [&](int i, int j, Index k) -> Index {
    if (i < 0 || i >= static_cast<int>(lattice.size())) return -1;
    const std::vector<Index>& column = lattice[static_cast<std::size_t>(i)];
    if (j < 0 || j >= static_cast<int>(column.size())) return -1;
    const Index fiber = column[static_cast<std::size_t>(j)];
    return k < 0 || k >= particles.size(fiber) ? -1 : particles.begin(fiber) + k;
  };
  const std::vector<std::array<int, 3>> steps = lattice_steps(diagonals);
  SpringPairs pairs;
  for (int i = 0; i < static_cast<int>(lattice.size()); ++i)
    for (int j = 0; j < static_cast<int>(lattice[static_cast<std::size_t>(i)].size()); ++j)
      for (Index k = 0; particle_at(i, j, k) >= 0; ++k)
        for (const auto& [di, dj, dk] : steps)
          if (const Index other = particle_at(i + di, j + dj, k + dk); other >= 0)
            pairs.push_back({particle_at(i, j, k), other});
  return sorted(std::move(pairs));
}

SpringPairs nearest_pairs(const Points& particles, Index count) {
  if (particles.cols() == 0) return {};
  const NearestPoints nearest(particles);
  SpringPairs pairs;
  for (Index p = 0; p < static_cast<Index>(particles.cols()); ++p) {
    std::vector<Index> found = nearest.query(particles.col(p), static_cast<std::size_t>(count) + 1);
    // Itself is among them, unless many others coincide with it.
    std::erase(found, p);
    found.resize(std::min(found.size(), static_cast<std::size_t>(count)));
    for (const Index other : found) pairs.push_back({p, other});
  }
  return sorted(std::move(pairs));
}

SpringPairs spring_pairs(const Polylines& particles, SpringLayout layout, Index neighbors) {
  switch (layout) {
    case SpringLayout::cubic_6:
      return cubic_pairs(particles, false);
    case SpringLayout::cubic_26:
      return cubic_pairs(particles, true);
    case SpringLayout::delaunay:
      return delaunay_edges(particles.points);
    case SpringLayout::nearest:
      break;
  }
  return nearest_pairs(particles.points, neighbors);
}

}  // namespace gracilis::mass_spring
