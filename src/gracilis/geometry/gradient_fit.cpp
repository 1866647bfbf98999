#include <gracilis/geometry/gradient_fit.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/opposite_vertices.hpp>
#include <gracilis/geometry/topology.hpp>

#include <Eigen/IterativeLinearSolvers>

#include <algorithm>

namespace gracilis {

/// Needles and vertices that touch would outweigh all others.
static constexpr Real greatest_weight = 10;
/// Every place is trusted this far: parts without a fixed vertex are held, too.
static constexpr Real least_trust = 1e-6;
/// Of conjugate gradients, relative.
static constexpr Real fit_residual = 1e-5;

GradientFit::GradientFit(const TriangleMesh& rest, const std::vector<char>& is_fixed, const Eigen::VectorXd& trust,
                         Real smoothing, Index largest_factorized) {
  const Eigen::VectorXd areas = vertex_areas(rest.vertices, rest.faces);
  const auto link = [&](Index a, Index b, Real area) {
    const Vec3 vector = rest.vertices.col(b) - rest.vertices.col(a);
    const Real length2 = vector.squaredNorm();
    if (length2 > 0) links_.push_back({a, b, std::min(2 * area / length2, greatest_weight), vector});
  };
  for (const MeshEdge& edge : build_topology(rest.faces, rest.vertex_count()).edges)
    link(edge.a, edge.b, area_at(edge, rest.vertices, rest.faces) / 3);
  const std::vector<Index> opposite = opposite_vertices(rest);
  for (Index v = 0; v < rest.vertex_count(); ++v)
    if (const Index other = opposite[static_cast<std::size_t>(v)]; other >= 0) link(v, other, areas[v] / 2);

  place_weights_ = areas.cwiseProduct(trust.cwiseMax(least_trust)) / (smoothing * smoothing);
  for (const char fixed : is_fixed) numbers_.push_back(fixed ? -1 : unknowns_++);
  matrix_ = normal_matrix();
  is_factorized_ = unknowns_ <= largest_factorized;
  if (!is_factorized_) return;
  factors_.factor(
      matrix_,
      "the surface that fits given gradients has no solution: its vertices are not finite, or far too large "
      "or small");
  matrix_.resize(0, 0);
}

Eigen::SparseMatrix<Real> GradientFit::normal_matrix() const {
  std::vector<Eigen::Triplet<Real>> entries;
  for (std::size_t v = 0; v < numbers_.size(); ++v)
    if (numbers_[v] >= 0) entries.emplace_back(numbers_[v], numbers_[v], place_weights_[static_cast<Index>(v)]);
  for (const Link& link : links_) {
    const Index a = number_of(link.a), b = number_of(link.b);
    for (const Index end : {a, b})
      if (end >= 0) entries.emplace_back(end, end, link.weight);
    if (a < 0 || b < 0) continue;
    entries.emplace_back(a, b, -link.weight);
    entries.emplace_back(b, a, -link.weight);
  }
  Eigen::SparseMatrix<Real> matrix(unknowns_, unknowns_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// One column per unknown.
Points GradientFit::right_side(const Aim& aim) const {
  const Points& places = aim.places;
  const std::vector<Eigen::Matrix3d>& gradients = aim.gradients;
  Points sum(3, unknowns_);
  for (Index v = 0; v < places.cols(); ++v)
    if (const Index i = number_of(v); i >= 0) sum.col(i) = place_weights_[v] * places.col(v);
  for (const Link& link : links_) {
    const Vec3 vector =
        (gradients[static_cast<std::size_t>(link.a)] + gradients[static_cast<std::size_t>(link.b)]) * (link.rest / 2);
    const auto pull = [&](Index vertex, Index other, const Vec3& from_other) {
      const Index i = number_of(vertex);
      if (i < 0) return;
      sum.col(i) += link.weight * from_other;
      if (number_of(other) < 0) sum.col(i) += link.weight * places.col(other);
    };
    pull(link.a, link.b, -vector);
    pull(link.b, link.a, vector);
  }
  return sum;
}

/// From the places on.
Points GradientFit::iterated(const Points& right_side, const Points& places) const {
  Points guess(3, unknowns_);
  for (Index v = 0; v < places.cols(); ++v)
    if (const Index i = number_of(v); i >= 0) guess.col(i) = places.col(v);
  Eigen::ConjugateGradient<Eigen::SparseMatrix<Real>, Eigen::Lower | Eigen::Upper> iteration(matrix_);
  iteration.setTolerance(fit_residual);
  Points solution(3, unknowns_);
  parallel_for(3, 1, [&](Index begin, Index end) {
    for (Index axis = begin; axis < end; ++axis)
      solution.row(axis) =
          iteration.solveWithGuess(right_side.row(axis).transpose(), guess.row(axis).transpose()).transpose();
  });
  return solution;
}

Points GradientFit::with_solution(const Points& places, const Points& solution) const {
  Points fitted = places;
  for (Index v = 0; v < places.cols(); ++v)
    if (const Index i = number_of(v); i >= 0) fitted.col(v) = solution.col(i);
  return fitted;
}

Points GradientFit::fitted(const Aim& aim) const {
  if (unknowns_ == 0) return aim.places;
  const Points sums = right_side(aim);
  return with_solution(aim.places, is_factorized_ ? factors_.solve_points(sums) : iterated(sums, aim.places));
}

std::pair<Points, Points> GradientFit::fitted(const Aim& first, const Aim& second) const {
  if (unknowns_ == 0 || !is_factorized_) return {fitted(first), fitted(second)};
  Eigen::Matrix<Real, 6, Eigen::Dynamic> sums(6, unknowns_);
  sums << right_side(first), right_side(second);
  const Eigen::Matrix<Real, 6, Eigen::Dynamic> solution = factors_.solve_points(sums);
  return {with_solution(first.places, solution.topRows<3>()), with_solution(second.places, solution.bottomRows<3>())};
}

}  // namespace gracilis
