#include <gracilis/geometry/revolution_fit.hpp>

#include <gracilis/geometry/principal_axes.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

constexpr int rounds = 12;

/// n·(a × p + b) as a row times (a, b), lengths in units of `scale` about `middle`.
Eigen::Matrix<Real, 6, 1> row_of(const SurfaceSamples& samples, Index i, const Vec3& middle, Real scale) {
  const Vec3 p = (samples.points.col(i) - middle) / scale, n = samples.normals.col(i);
  Eigen::Matrix<Real, 6, 1> row;
  row << p.cross(n), n;
  return row;
}

}  // namespace

RevolutionFit fit_revolution(const SurfaceSamples& samples, const Vec3& expected, Real bias) {
  RevolutionFit fit;
  if (samples.count() < 12) return fit;
  const Vec3 middle = samples.points * samples.areas / samples.areas.sum();
  const Real scale = std::sqrt((samples.points.colwise() - middle).colwise().squaredNorm().mean());
  Eigen::VectorXd weights = samples.areas / samples.areas.sum();
  Vec3 direction = expected.normalized(), shift = Vec3::Zero();
  for (int round = 0; round < rounds; ++round) {
    Eigen::Matrix<Real, 6, 6> sum = Eigen::Matrix<Real, 6, 6>::Zero();
    for (Index i = 0; i < samples.count(); ++i) {
      const Eigen::Matrix<Real, 6, 1> row = row_of(samples, i, middle, scale);
      sum += weights[i] * row * row.transpose();
    }
    // What is best for b, given a, leaves a form in a alone.
    const Eigen::Matrix3d of_shift = sum.bottomRightCorner<3, 3>() + 1e-9 * Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d mixed = sum.bottomLeftCorner<3, 3>();
    const Eigen::Matrix3d solved = of_shift.ldlt().solve(mixed);
    const Vec3 wish = expected.normalized();
    const Eigen::Matrix3d form = sum.topLeftCorner<3, 3>() - mixed.transpose() * solved +
                                 weights.sum() * bias * bias * (Eigen::Matrix3d::Identity() - wish * wish.transpose());
    direction = principal_axes(form).least();
    if (direction.dot(wish) < 0) direction = -direction;
    shift = -solved * direction;
    Eigen::VectorXd misses(samples.count());
    for (Index i = 0; i < samples.count(); ++i) {
      Eigen::Matrix<Real, 6, 1> screw;
      screw << direction, shift;
      const Vec3 p = (samples.points.col(i) - middle) / scale;
      misses[i] = row_of(samples, i, middle, scale).dot(screw) / std::max((direction.cross(p) + shift).norm(), 0.05);
    }
    fit.misfit = std::sqrt((samples.areas.array() * misses.array().square()).sum() / samples.areas.sum());
    const Real spread = std::max(0.05, fit.misfit);
    weights = samples.areas / samples.areas.sum();
    for (Index i = 0; i < samples.count(); ++i) weights[i] /= 1 + std::pow(misses[i] / spread, 2);
  }
  fit.direction = direction;
  const Vec3 turning = shift - shift.dot(direction) * direction;  // without the screw's pitch
  const Vec3 on_axis = middle + scale * direction.cross(turning);
  fit.center = on_axis + (middle - on_axis).dot(direction) * direction;
  for (Index i = 0; i < samples.count(); ++i)
    fit.radius += (samples.points.col(i) - fit.center).cross(direction).norm() * samples.areas[i] / samples.areas.sum();
  return fit;
}

}  // namespace gracilis
