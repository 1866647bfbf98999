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
template <int Rows>
Eigen::Matrix<Real, Rows, Eigen::Dynamic> GradientFit::right_side(const AimOf<Rows>& aim) const {
  using Column = Eigen::Matrix<Real, Rows, 1>;
  Eigen::Matrix<Real, Rows, Eigen::Dynamic> sum(Rows, unknowns_);
  for (Index v = 0; v < aim.places.cols(); ++v)
    if (const Index i = number_of(v); i >= 0) sum.col(i) = place_weights_[v] * aim.places.col(v);
  for (const Link& link : links_) {
    const Index a = number_of(link.a), b = number_of(link.b);
    const auto &at_a = aim.gradients[static_cast<std::size_t>(link.a)],
               &at_b = aim.gradients[static_cast<std::size_t>(link.b)];
    const Vec3 rest = link.weight / 2 * link.rest;
    const Column vector = (at_a + at_b) * rest;
    if (a >= 0) sum.col(a) -= vector;
    if (b >= 0) sum.col(b) += vector;
    if (a >= 0 && b < 0) sum.col(a) += link.weight * aim.places.col(link.b);
    if (b >= 0 && a < 0) sum.col(b) += link.weight * aim.places.col(link.a);
  }
  return sum;
}

/// From the places on.
template <int Rows>
Eigen::Matrix<Real, Rows, Eigen::Dynamic> GradientFit::iterated(
    const Eigen::Matrix<Real, Rows, Eigen::Dynamic>& right_side,
    const Eigen::Matrix<Real, Rows, Eigen::Dynamic>& places) const {
  Eigen::Matrix<Real, Rows, Eigen::Dynamic> guess(Rows, unknowns_), solution(Rows, unknowns_);
  for (Index v = 0; v < places.cols(); ++v)
    if (const Index i = number_of(v); i >= 0) guess.col(i) = places.col(v);
  Eigen::ConjugateGradient<Eigen::SparseMatrix<Real>, Eigen::Lower | Eigen::Upper> iteration(matrix_);
  iteration.setTolerance(fit_residual);
  parallel_for(Rows, 1, [&](Index begin, Index end) {
    for (Index axis = begin; axis < end; ++axis)
      solution.row(axis) =
          iteration.solveWithGuess(right_side.row(axis).transpose(), guess.row(axis).transpose()).transpose();
  });
  return solution;
}

template <int Rows>
Eigen::Matrix<Real, Rows, Eigen::Dynamic> GradientFit::fitted(const AimOf<Rows>& aim) const {
  Eigen::Matrix<Real, Rows, Eigen::Dynamic> fitted = aim.places;
  if (unknowns_ == 0) return fitted;
  const Eigen::Matrix<Real, Rows, Eigen::Dynamic> sums = right_side(aim);
  const Eigen::Matrix<Real, Rows, Eigen::Dynamic> solution =
      is_factorized_ ? factors_.solve_points(sums) : iterated(sums, aim.places);
  for (Index v = 0; v < fitted.cols(); ++v)
    if (const Index i = number_of(v); i >= 0) fitted.col(v) = solution.col(i);
  return fitted;
}

template Points GradientFit::fitted(const AimOf<3>&) const;
template Eigen::Matrix<Real, 6, Eigen::Dynamic> GradientFit::fitted(const AimOf<6>&) const;

}  // namespace gracilis
