#include <gracilis/methods/rbf/curvature_cost.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/core/stop.hpp>

#include <algorithm>

namespace gracilis::rbf {

namespace {

constexpr Index grain = 16;

/// Whether a function is felt so far away; Gaussians are below the last digit beyond six reaches.
bool is_felt(const RadialBasis& basis, Index center, const Vec3& from) {
  if (basis.kernel.shape != RadialShape::gaussian) return true;
  return from.squaredNorm() < 36 * basis.reaches[center] * basis.reaches[center];
}

/// The field's curvature (eq. 6.5).
Real curvature_at(const RadialBasis& basis, const Vec3& point) {
  Real sum = 0;
  for (Index k = 0; k < basis.count(); ++k) {
    const Vec3 from = point - basis.centers.col(k);
    if (!is_felt(basis, k, from)) continue;
    const RadialProfile at = radial_profile(basis.kernel, basis.reaches[k], from.norm());
    sum += basis.weights[k] * (at.second + (basis.dimensions - 1) * at.slope_over_r);
  }
  return sum / basis.dimensions;
}

/// κ - κ_0 at every point.
Eigen::VectorXd differences(const RadialBasis& basis, const CurvaturePoints& wanted) {
  Eigen::VectorXd off(wanted.points.cols());
  parallel_for(static_cast<Index>(off.size()), grain, [&](Index begin, Index end) {
    for (Index q = begin; q < end; ++q) off[q] = curvature_at(basis, wanted.points.col(q)) - wanted.curvatures[q];
  });
  return off;
}

}  // namespace

Real curvature_cost(const RadialBasis& basis, const CurvaturePoints& wanted) {
  return wanted.share * differences(basis, wanted).squaredNorm();
}

Points curvature_cost_gradient(const RadialBasis& basis, const CurvaturePoints& wanted) {
  const Eigen::VectorXd off = differences(basis, wanted);
  const Real others = basis.dimensions - 1;
  Points gradient = Points::Zero(3, basis.count());
  parallel_for(basis.count(), grain, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const Real factor = -2 * wanted.share * basis.weights[k] / basis.dimensions;
      for (Index q = 0; q < static_cast<Index>(off.size()); ++q) {
        const Vec3 from = wanted.points.col(q) - basis.centers.col(k);
        const Real r = from.norm();
        if (r == 0 || !is_felt(basis, k, from)) continue;
        const RadialProfile at = radial_profile(basis.kernel, basis.reaches[k], r);
        const Real bend = at.third + others * (at.second - at.slope_over_r) / r;
        gradient.col(k) += factor * off[q] * bend / r * from;
      }
    }
  });
  return gradient;
}

Descent descend(RadialBasis& basis, const CurvaturePoints& wanted, const std::vector<char>& is_free, int most_steps,
                Real longest_step) {
  constexpr Real sufficient = 1e-4;  // of what the slope promises
  constexpr int most_halvings = 12;
  Descent done;
  done.before = done.after = curvature_cost(basis, wanted);
  Points last_centers, last_gradient;
  for (int i = 0; i < most_steps; ++i) {
    throw_if_stopped();
    Points gradient = curvature_cost_gradient(basis, wanted);
    for (Index k = 0; k < basis.count(); ++k)
      if (!is_free[static_cast<std::size_t>(k)]) gradient.col(k).setZero();
    const Real steepest = gradient.colwise().norm().maxCoeff();
    if (!(steepest > 0)) break;
    Real step = longest_step / steepest;
    // The step that the last one's change of slope suggests (Barzilai and Borwein 1988), where that is shorter.
    if (i > 0) {
      const Points moved = basis.centers - last_centers;
      const Real bend = moved.cwiseProduct(gradient - last_gradient).sum();
      if (bend > 0) step = std::min(step, moved.squaredNorm() / bend);
    }
    last_centers = basis.centers;
    last_gradient = gradient;
    const Real promised = gradient.squaredNorm();
    bool is_lower = false;
    for (int halving = 0; halving < most_halvings && !is_lower; ++halving, step /= 2) {
      basis.centers = last_centers - step * gradient;
      const Real cost = curvature_cost(basis, wanted);
      is_lower = cost <= done.after - sufficient * step * promised;
      if (is_lower) done.after = cost;
    }
    if (!is_lower) {
      basis.centers = last_centers;
      break;
    }
    ++done.steps;
  }
  return done;
}

}  // namespace gracilis::rbf
