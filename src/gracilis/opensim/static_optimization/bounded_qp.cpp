#include <gracilis/opensim/static_optimization/bounded_qp.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

using Vector = Eigen::VectorXd;

/// For dual variables `l`: the x that minimizes the Lagrangian.
static Vector primal(const BoundedQp& p, const Vector& l) {
  return (p.centers + (p.a.transpose() * l).cwiseQuotient(p.weights)).cwiseMax(p.lower).cwiseMin(p.upper);
}

/// The negative dual function with its proximal term; `x` belongs to `l`.
static Real dual(const BoundedQp& p, const Vector& l, const Vector& x, const Vector& around, Real proximity) {
  return (p.a.transpose() * l).dot(x) - 0.5 * p.weights.dot((x - p.centers).cwiseAbs2()) - p.b.dot(l) +
         0.5 * proximity * (l - around).squaredNorm();
}

/// Newton's method on the dual with proximal term; its gradient is A x - b + proximity (l - around).
static Vector minimize_dual(const BoundedQp& p, const Vector& around, Real proximity, Real tolerance) {
  Vector l = around;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const Vector x = primal(p, l);
    const Vector gradient = p.a * x - p.b + proximity * (l - around);
    if (gradient.lpNorm<Eigen::Infinity>() < tolerance) break;
    const Vector free = ((x.array() > p.lower.array()) && (x.array() < p.upper.array()))
                            .select(p.weights.cwiseInverse(), Vector::Zero(x.size()));
    Eigen::MatrixXd curvature = p.a * free.asDiagonal() * p.a.transpose();
    curvature.diagonal().array() += proximity;
    const Vector step = -curvature.ldlt().solve(gradient);
    const Real before = dual(p, l, x, around, proximity), slope = gradient.dot(step);
    Real length = 1;
    for (; length > 1e-12; length /= 2) {
      const Vector next = l + length * step;
      if (dual(p, next, primal(p, next), around, proximity) <= before + 1e-4 * length * slope) break;
    }
    if (length <= 1e-12) break;  // no progress left at this precision
    l += length * step;
  }
  return l;
}

/// Rows divided by the largest sum that they can reach, so that a tolerance fits all.
static Vector row_scales(const BoundedQp& problem) {
  Vector scales = Vector::Ones(problem.b.size());
  for (Eigen::Index row = 0; row < scales.size(); ++row) {
    const Real size = std::max(problem.a.row(row).norm(), std::abs(problem.b[row]) * 1e-3);
    if (size > 0) scales[row] = 1 / size;
  }
  return scales;
}

BoundedQpSolution solve(const BoundedQp& problem, Real tolerance) {
  BoundedQp p = problem;
  const Vector scales = row_scales(problem);
  p.a = scales.asDiagonal() * problem.a;
  p.b = scales.cwiseProduct(problem.b);
  Real proximity =
      1e-3 * std::max((p.a * p.weights.cwiseInverse().asDiagonal() * p.a.transpose()).trace() / p.b.size(), 1e-12);
  Vector l = Vector::Zero(p.b.size()), before = Vector::Zero(p.b.size());
  BoundedQpSolution solution;
  const Real least = 1e-6 * proximity;
  for (int step = 0; step < 200; ++step) {
    l = minimize_dual(p, l, proximity, 1e-3 * tolerance);
    proximity = std::max(proximity / 2, least);  // rows that say nearly the same need steps that go far
    solution.x = primal(p, l);
    const Vector missing = p.b - p.a * solution.x;
    solution.feasible = missing.lpNorm<Eigen::Infinity>() < tolerance;
    const bool settled = (missing - before).norm() < 1e-6 * missing.norm();
    before = missing;
    if (solution.feasible || (settled && step > 2)) break;
  }
  solution.missing = problem.b - problem.a * solution.x;
  return solution;
}

BoundedQpSolution minimize_powers(BoundedQp problem, Real power) {
  problem.weights = Vector::Ones(problem.a.cols());
  problem.centers = Vector::Zero(problem.a.cols());
  BoundedQpSolution best = solve(problem);
  if (power == 2 || !best.feasible) return best;
  const auto cost = [&](const Vector& x) { return x.cwiseAbs().array().pow(power).sum(); };
  for (int iteration = 0; iteration < 200; ++iteration) {
    // The cost's parabola at x; where it is flat or infinitely sharp, a parabola that still leads downhill.
    const Vector size = best.x.cwiseAbs().cwiseMax(1e-4);
    const Vector slope = power * size.array().pow(power - 1) * best.x.array().sign();
    problem.weights = power * (power - 1) * size.array().pow(power - 2);
    problem.centers = best.x - slope.cwiseQuotient(problem.weights);
    const BoundedQpSolution next = solve(problem);
    if (!next.feasible) break;
    const Vector step = next.x - best.x;
    const Real before = cost(best.x), downhill = slope.dot(step);
    if (step.lpNorm<Eigen::Infinity>() < 1e-9) break;
    Real length = 1;
    while (length > 1e-9 && cost(best.x + length * step) > before + 1e-4 * length * downhill) length /= 2;
    if (length <= 1e-9) break;
    best.x += length * step;
  }
  best.missing = problem.b - problem.a * best.x;
  return best;
}

}  // namespace gracilis::opensim
