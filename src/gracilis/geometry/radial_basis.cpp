#include <gracilis/geometry/radial_basis.hpp>

#include <gracilis/core/parallel.hpp>

namespace gracilis {

namespace {

/// The polynomial's value.
Real polynomial_value(const RadialBasis& basis, const Vec3& point) {
  const auto& a = basis.polynomial;
  if (a.size() == 0) return 0;
  Real value = a[0];
  for (Eigen::Index k = 1; k < a.size(); ++k) value += a[k] * (point[k - 1] - basis.origin[k - 1]) / basis.size;
  return value;
}

Vec3 polynomial_gradient(const RadialBasis& basis) {
  Vec3 gradient = Vec3::Zero();
  for (Eigen::Index k = 1; k < basis.polynomial.size(); ++k) gradient[k - 1] = basis.polynomial[k] / basis.size;
  return gradient;
}

Eigen::Matrix3d unit_of(int dimensions) {
  Eigen::Matrix3d unit = Eigen::Matrix3d::Zero();
  unit.topLeftCorner(dimensions, dimensions).setIdentity();
  return unit;
}

}  // namespace

Real value_at(const RadialBasis& basis, const Vec3& point) {
  Real value = polynomial_value(basis, point);
  for (Index i = 0; i < basis.count(); ++i)
    value += basis.weights[i] * radial_value(basis.kernel, basis.reaches[i], (point - basis.centers.col(i)).norm());
  return value;
}

Eigen::VectorXd errors_at(const RadialBasis& basis, const Points& points, const Eigen::VectorXd& values) {
  Eigen::VectorXd errors(points.cols());
  parallel_for(static_cast<Index>(points.cols()), 64, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) errors[i] = value_at(basis, points.col(i)) - values[i];
  });
  return errors;
}

RadialSample slope_at(const RadialBasis& basis, const Vec3& point) {
  RadialSample result;
  result.value = polynomial_value(basis, point);
  result.gradient = polynomial_gradient(basis);
  for (Index i = 0; i < basis.count(); ++i) {
    const Vec3 from = point - basis.centers.col(i);
    const RadialProfile at = radial_profile(basis.kernel, basis.reaches[i], from.norm());
    result.value += basis.weights[i] * at.value;
    if (from != Vec3::Zero()) result.gradient += basis.weights[i] * at.slope_over_r * from;
  }
  return result;
}

RadialSample sample(const RadialBasis& basis, const Vec3& point) {
  RadialSample result = slope_at(basis, point);
  const Eigen::Matrix3d unit = unit_of(basis.dimensions);
  for (Index i = 0; i < basis.count(); ++i) {
    const Vec3 from = point - basis.centers.col(i);
    const Real r = from.norm();
    const RadialProfile at = radial_profile(basis.kernel, basis.reaches[i], r);
    const Vec3 way = r > 0 ? Vec3(from / r) : Vec3::Zero();
    for (int j = 0; j < basis.dimensions; ++j)
      for (int k = 0; k < basis.dimensions; ++k) {
        // Written apart, since infinity times 0 has no value.
        const Real along = r > 0 ? (at.second - at.slope_over_r) * way[j] * way[k] : 0;
        if (unit(j, k) != 0) result.hessian(j, k) += basis.weights[i] * at.slope_over_r;
        result.hessian(j, k) += basis.weights[i] * along;
      }
  }
  return result;
}

Real field_curvature(const RadialBasis& basis, const Vec3& point) {
  Real sum = 0;
  for (Index i = 0; i < basis.count(); ++i) {
    const RadialProfile at = radial_profile(basis.kernel, basis.reaches[i], (point - basis.centers.col(i)).norm());
    sum += basis.weights[i] * (at.second + (basis.dimensions - 1) * at.slope_over_r);
  }
  return sum / basis.dimensions;
}

Real surface_mean_curvature(const RadialSample& at) {
  const Real length = at.gradient.norm();
  const Vec3 n = at.gradient / length;
  return (at.hessian.trace() - n.dot(at.hessian * n)) / (2 * length);
}

}  // namespace gracilis
