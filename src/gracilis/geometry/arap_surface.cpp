#include <gracilis/geometry/arap_surface.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/rotations.hpp>

#include <algorithm>

namespace gracilis::arap {

namespace {

/// Vertices that one task takes.
constexpr Index grain = 256;

/// Cotangent of the angle at `apex` between a and b; 0 where the triangle has no area.
Real cotangent(const Points& x, Index apex, Index a, Index b) {
  if (apex < 0) return 0;
  const Vec3 u = x.col(a) - x.col(apex), v = x.col(b) - x.col(apex);
  const Real twice_area = u.cross(v).norm();
  return twice_area > 0 ? u.dot(v) / twice_area : 0;
}

Real weight_of(const MeshEdge& edge, const Points& x) {
  const Real both = cotangent(x, edge.left_apex, edge.a, edge.b) + cotangent(x, edge.right_apex, edge.a, edge.b);
  // Needles have cotangents without end, whose matrix has no digits left.
  return std::clamp(both / 2, Surface::smallest_weight, 1 / Surface::smallest_weight);
}

}  // namespace

Surface::Surface(const TriangleMesh& mesh, const MeshTopology& topology, const std::vector<char>& held)
    : rest_(mesh.vertices), stars_(topology.stars) {
  weights_.resize(stars_.neighbors.size());
  const auto set_weight = [&](Index from, Index to, Real weight) {
    const auto begin = stars_.neighbors.begin() + stars_.offsets[static_cast<std::size_t>(from)];
    const auto end = stars_.neighbors.begin() + stars_.offsets[static_cast<std::size_t>(from) + 1];
    weights_[static_cast<std::size_t>(std::lower_bound(begin, end, to) - stars_.neighbors.begin())] = weight;
  };
  for (const char each : held) unknown_.push_back(each ? -1 : unknown_count_++);
  std::vector<Eigen::Triplet<Real>> entries;
  for (const MeshEdge& edge : topology.edges) {
    const Real weight = weight_of(edge, rest_);
    set_weight(edge.a, edge.b, weight);
    set_weight(edge.b, edge.a, weight);
    const Index a = unknown_[static_cast<std::size_t>(edge.a)], b = unknown_[static_cast<std::size_t>(edge.b)];
    if (a >= 0) entries.emplace_back(a, a, weight);
    if (b >= 0) entries.emplace_back(b, b, weight);
    if (a >= 0 && b >= 0) entries.emplace_back(a, b, -weight), entries.emplace_back(b, a, -weight);
  }
  if (unknown_count_ == 0) return;
  Eigen::SparseMatrix<Real> matrix(unknown_count_, unknown_count_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factors_.factor(matrix,
                  "an as-rigid-as-possible surface has no solution: its vertices are not finite, or far too large or "
                  "small");
}

Rotations Surface::best_rotations(const Points& points) const {
  Rotations rotations(unknown_.size());
  parallel_for(static_cast<Index>(unknown_.size()), grain, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
      for (Index k = stars_.offsets[at]; k < stars_.offsets[at + 1]; ++k) {
        const Index j = stars_.neighbors[static_cast<std::size_t>(k)];
        covariance += weights_[static_cast<std::size_t>(k)] * (rest_.col(i) - rest_.col(j)) *
                      (points.col(i) - points.col(j)).transpose();
      }
      rotations[at] = nearest_rotation(covariance).transpose();
    }
  });
  return rotations;
}

void Surface::place(const Rotations& rotations, Points& points) const {
  if (unknown_count_ == 0) return;
  // Solved for the change: what fits already then stays to the last digits.
  Points right = Points::Zero(3, unknown_count_);
  parallel_for(static_cast<Index>(unknown_.size()), grain, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (unknown_[at] < 0) continue;
      Vec3 sum = Vec3::Zero();
      for (Index k = stars_.offsets[at]; k < stars_.offsets[at + 1]; ++k) {
        const Index j = stars_.neighbors[static_cast<std::size_t>(k)];
        const Eigen::Matrix3d mean = (rotations[at] + rotations[static_cast<std::size_t>(j)]) / 2;
        sum += weights_[static_cast<std::size_t>(k)] *
               (mean * (rest_.col(i) - rest_.col(j)) - (points.col(i) - points.col(j)));
      }
      right.col(unknown_[at]) = sum;
    }
  });
  const Points change = factors_.solve_points(right);
  for (std::size_t i = 0; i < unknown_.size(); ++i)
    if (unknown_[i] >= 0) points.col(static_cast<Index>(i)) += change.col(unknown_[i]);
}

void Surface::relax(int rounds, Points& points) const {
  for (int round = 0; round < rounds; ++round) place(best_rotations(points), points);
}

Points Surface::response(const Points& forces) const {
  Points response = Points::Zero(3, forces.cols());
  if (unknown_count_ == 0) return response;
  Points right(3, unknown_count_);
  for (std::size_t i = 0; i < unknown_.size(); ++i)
    if (unknown_[i] >= 0) right.col(unknown_[i]) = forces.col(static_cast<Index>(i));
  const Points solution = factors_.solve_points(right);
  for (std::size_t i = 0; i < unknown_.size(); ++i)
    if (unknown_[i] >= 0) response.col(static_cast<Index>(i)) = solution.col(unknown_[i]);
  return response;
}

Real Surface::energy(const Points& points, const Rotations& rotations) const {
  Real sum = 0;
  for (std::size_t i = 0; i < unknown_.size(); ++i)
    for (Index k = stars_.offsets[i]; k < stars_.offsets[i + 1]; ++k) {
      const auto at = static_cast<Index>(i);
      const Index j = stars_.neighbors[static_cast<std::size_t>(k)];
      sum += weights_[static_cast<std::size_t>(k)] *
             (points.col(at) - points.col(j) - rotations[i] * (rest_.col(at) - rest_.col(j))).squaredNorm();
    }
  return sum;
}

}  // namespace gracilis::arap
