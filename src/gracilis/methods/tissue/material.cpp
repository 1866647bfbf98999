#include <gracilis/methods/tissue/material.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis::tissue {

namespace {

/// Slack fibers keep this share of their tension at rest, so that none buckles.
constexpr Real slack_share = 0.2;

/// The force-length curve by Blemker, Pinsky and Delp (2005), 1 at x = 1; `energy` is its integral from 0.4.
Curve force_length(Real x) {
  const auto cube = [](Real y) { return y * y * y; };
  const auto rising = [&](Real y) { return 3 * cube(y - 0.4); };
  const auto middle = [&](Real y) { return y - 1 - 4.0 / 3 * cube(y - 1); };
  const auto falling = [&](Real y) { return 3 * cube(y - 1.6); };
  if (x <= 0.4) return {};
  if (x <= 0.6) return {rising(x), 9 * (x - 0.4) * (x - 0.4), 18 * (x - 0.4)};
  const Real to_middle = rising(0.6) - middle(0.6);
  if (x <= 1.4) return {to_middle + middle(x), 1 - 4 * (x - 1) * (x - 1), -8 * (x - 1)};
  const Real to_falling = to_middle + middle(1.4) - falling(1.4);
  if (x <= 1.6) return {to_falling + falling(x), 9 * (x - 1.6) * (x - 1.6), 18 * (x - 1.6)};
  return {to_falling, 0, 0};
}

Curve passive(const FiberLaw& law, Real stretch) {
  const Real strain = stretch - 1, taut = std::max(strain, slack_strain(law));
  const Real tension = law.rest_tension + law.stiffness * taut;
  return {taut * (law.rest_tension + law.stiffness / 2 * taut) + tension * (strain - taut), tension,
          strain < taut ? 0 : law.stiffness};
}

}  // namespace

Real slack_strain(const FiberLaw& law) {
  return law.stiffness > 0 ? (slack_share - 1) * law.rest_tension / law.stiffness
                           : -std::numeric_limits<Real>::infinity();
}

Curve fiber_curve(const FiberLaw& law, Real stretch) {
  Curve sum = passive(law, stretch);
  if (!(law.active_tension > 0)) return sum;
  const Curve active = force_length(stretch / law.optimal_stretch);
  sum.energy += law.active_tension * law.optimal_stretch * active.energy;
  sum.slope += law.active_tension * active.slope;
  sum.curvature += law.active_tension / law.optimal_stretch * active.curvature;
  return sum;
}

Curve shear_curve(const MatrixLaw& law, Real squared_size) {
  const Real strain = squared_size - 3, drawn_out = std::max(strain, 0.0);
  const Real stiffer = law.stiffening * drawn_out * drawn_out;
  return {law.shear / 2 * (strain + stiffer * drawn_out / 3), law.shear * (1 + stiffer),
          4 * law.shear * law.stiffening * drawn_out};
}

Curve volume_curve(const MatrixLaw& law, Real j) {
  Curve sum = {-law.shear * (j - 1) + law.lambda / 2 * (j - 1) * (j - 1), -law.shear + law.lambda * (j - 1),
               law.lambda};
  if (j >= barrier_begin) return sum;
  // -k (J - J0)² log(J / J0): twice continuously differentiable where it begins (Li et al. 2020).
  const Real k = std::max(law.lambda, barrier_per_shear * law.shear), d = j - barrier_begin,
             log = std::log(j / barrier_begin);
  sum.energy -= k * d * d * log;
  sum.slope -= k * (2 * d * log + d * d / j);
  sum.curvature -= k * (2 * log + 4 * d / j - d * d / (j * j));
  return sum;
}

Real tissue_energy(const MatrixLaw& matrix, const FiberLaw& fibers, const Vec3& direction, const Matrix3& f,
                   Matrix3& stress) {
  const Matrix3 cofactor = cofactors(f);
  const Curve volume = volume_curve(matrix, f.col(0).dot(cofactor.col(0)));
  const Curve shear = shear_curve(matrix, f.squaredNorm());
  Real energy = shear.energy + volume.energy;
  stress = shear.slope * f + volume.slope * cofactor;
  const Vec3 along = f * direction;
  const Real stretch = along.norm();
  if (stretch > 0) {
    const Curve fiber = fiber_curve(fibers, stretch);
    energy += fiber.energy;
    stress += (fiber.slope / stretch) * along * direction.transpose();
  }
  return energy;
}

Matrix9 tissue_hessian(const MatrixLaw& matrix, const FiberLaw& fibers, const Vec3& direction, const Matrix3& f) {
  const Matrix3 cofactor = cofactors(f);
  const Curve volume = volume_curve(matrix, f.col(0).dot(cofactor.col(0)));
  const Curve shear = shear_curve(matrix, f.squaredNorm());
  using Entries = Eigen::Map<const Eigen::Matrix<Real, 9, 1>>;
  const Entries c(cofactor.data()), entries(f.data());
  Matrix9 h = shear.slope * Matrix9::Identity() + shear.curvature * entries * entries.transpose() +
              volume.curvature * c * c.transpose();
  // The cofactors are cross products of columns, so their derivatives by columns are cross product matrices.
  const auto cross = [](const Vec3& v) { return Matrix3{{0, -v.z(), v.y()}, {v.z(), 0, -v.x()}, {-v.y(), v.x(), 0}}; };
  for (Index a = 0; a < 3; ++a) {
    const Index b = (a + 1) % 3, d = (a + 2) % 3;
    h.block<3, 3>(3 * a, 3 * b) -= volume.slope * cross(f.col(d));
    h.block<3, 3>(3 * a, 3 * d) += volume.slope * cross(f.col(b));
  }
  const Vec3 along = f * direction;
  const Real stretch = along.norm();
  if (stretch > 0) {
    const Curve fiber = fiber_curve(fibers, stretch);
    const Vec3 n = along / stretch;
    const Matrix3 inner =
        fiber.curvature * n * n.transpose() + fiber.slope / stretch * (Matrix3::Identity() - n * n.transpose());
    for (Index a = 0; a < 3; ++a)
      for (Index b = 0; b < 3; ++b) h.block<3, 3>(3 * a, 3 * b) += direction[a] * direction[b] * inner;
  }
  return h;
}

}  // namespace gracilis::tissue
