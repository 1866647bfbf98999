#include <gracilis/geometry/thin_plate.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>

namespace gracilis {
namespace {

/// 1 and the coordinates, a row per point.
Eigen::MatrixXd affine_rows(const Points& points) {
  Eigen::MatrixXd rows(points.cols(), 4);
  rows.col(0).setOnes();
  rows.rightCols(3) = points.transpose();
  return rows;
}

Eigen::MatrixXd distances(const Points& points, const Points& centers) {
  Eigen::MatrixXd result(points.cols(), centers.cols());
  parallel_for(static_cast<Index>(points.cols()), 256, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) result.row(i) = (centers.colwise() - points.col(i)).colwise().norm();
  });
  return result;
}

/// rowsᵀ diag(weights) rows.
Eigen::MatrixXd weighted_square(const Eigen::MatrixXd& rows, const Eigen::VectorXd& weights) {
  return rows.transpose() * (weights.asDiagonal() * rows);
}

/// A little for the affine functions: points in a plane leave one of them free.
constexpr Real least_stiffness = 1e-12;

Eigen::LLT<Eigen::MatrixXd> cholesky(const Eigen::MatrixXd& matrix) {
  Eigen::LLT<Eigen::MatrixXd> factors(matrix);
  if (factors.info() != Eigen::Success)
    throw QualityError(
        "a thin plate has no solution: points that it goes through coincide, are not finite, or lie far too "
        "wide apart");
  return factors;
}

/// Where all directions count alike the three coordinates are told one by one.
Eigen::MatrixXd decoupled(const Eigen::MatrixXd& rows, const Eigen::VectorXd& shares, const Points& displacement,
                          Real stiffness) {
  Eigen::MatrixXd matrix = weighted_square(rows, shares);
  matrix.diagonal().array() += least_stiffness;
  matrix.diagonal().tail(rows.cols() - 4).array() += stiffness;
  return cholesky(matrix).solve(rows.transpose() * (shares.asDiagonal() * displacement.transpose()));
}

/// Of the displacement in units of the size, the map.
ThinPlateMap with_affine_part(const ThinPlateBasis& basis, Eigen::MatrixXd coefficients) {
  coefficients *= basis.size();
  coefficients.row(0) += basis.origin().transpose();
  for (int a = 0; a < 3; ++a) coefficients(1 + a, a) += basis.size();
  return ThinPlateMap(basis, coefficients);
}

}  // namespace

ThinPlateBasis::ThinPlateBasis(const Points& centers) : centers_(centers) {
  if (centers.cols() == 0) return;
  origin_ = centers.rowwise().mean();
  size_ = std::sqrt((centers.colwise() - origin_).colwise().squaredNorm().mean());
  const Points unit = (centers.colwise() - origin_) / size_;
  const Index n = static_cast<Index>(centers.cols());
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(affine_rows(unit));
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd blind = q.rightCols(n - 4);  // to affine maps
  // |x| is conditionally negative definite.
  const Eigen::MatrixXd energy = -(blind.transpose() * distances(unit, unit) * blind);
  const Eigen::LLT<Eigen::MatrixXd> factors = cholesky((energy + energy.transpose()) / 2);
  bending_ = factors.matrixL().solve(blind.transpose()).transpose();
}

Eigen::MatrixXd ThinPlateBasis::rows(const Points& points) const {
  const Points unit = (points.colwise() - origin_) / size_;
  Eigen::MatrixXd result(points.cols(), count());
  result.leftCols(4) = affine_rows(unit);
  if (bending_.cols() > 0)
    result.rightCols(bending_.cols()) = distances(unit, (centers_.colwise() - origin_) / size_) * bending_;
  return result;
}

Eigen::MatrixXd ThinPlateBasis::kernel_weights(const Eigen::MatrixXd& coefficients) const {
  Eigen::MatrixXd weights(centers_.cols() + 4, coefficients.cols());
  weights.topRows(centers_.cols()) = bending_ * coefficients.bottomRows(coefficients.rows() - 4);
  weights.bottomRows(4) = coefficients.topRows(4);
  return weights;
}

ThinPlateMap::ThinPlateMap(const ThinPlateBasis& basis, const Eigen::MatrixXd& coefficients)
    : centers_(basis.centers()) {
  const Eigen::MatrixXd weights = basis.kernel_weights(coefficients);
  weights_ = weights.topRows(centers_.cols()).transpose() / basis.size();
  linear_ = weights.bottomRows(3).transpose() / basis.size();
  shift_ = weights.row(centers_.cols()).transpose() - linear_ * basis.origin();
}

ThinPlateMap ThinPlateMap::affine(const Eigen::Matrix3d& linear, const Vec3& shift) {
  ThinPlateMap map;
  map.linear_ = linear;
  map.shift_ = shift;
  return map;
}

Vec3 ThinPlateMap::at(const Vec3& p) const {
  Vec3 q = linear_ * p + shift_;
  for (Index k = 0; k < centers_.cols(); ++k) q += weights_.col(k) * (p - centers_.col(k)).norm();
  return q;
}

Points ThinPlateMap::at(const Points& points) const {
  Points result(3, points.cols());
  parallel_for(static_cast<Index>(points.cols()), 64, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) result.col(i) = at(Vec3(points.col(i)));
  });
  return result;
}

Eigen::Matrix3d ThinPlateMap::slope(const Vec3& p) const {
  Eigen::Matrix3d result = linear_;
  for (Index k = 0; k < centers_.cols(); ++k) {
    const Vec3 way = p - centers_.col(k);
    if (const Real distance = way.norm(); distance > 0) result += weights_.col(k) * (way / distance).transpose();
  }
  return result;
}

ThinPlateMap fit_thin_plate(const ThinPlateBasis& basis, const PlaceTargets& targets, Real stiffness) {
  const Index n = basis.count();
  const Eigen::MatrixXd rows = basis.rows(targets.points);
  const Eigen::VectorXd shares = targets.weights / targets.weights.sum();
  const Points displacement = (targets.places - targets.points) / basis.size();
  // Each point's cost is |M (G x - d)|² with M² = n nᵀ + along (1 - n nᵀ): six blocks of rowsᵀ M²_ab rows.
  const auto cost = [&](int a, int b) -> Eigen::VectorXd {
    const Eigen::ArrayXd across = (targets.normals.row(a).array() * targets.normals.row(b).array()).transpose();
    const Eigen::ArrayXd is_plane = (targets.normals.colwise().squaredNorm().array() > 0).cast<Real>().transpose();
    const Real same = a == b ? 1 : 0;
    const Eigen::ArrayXd all =
        (1 - targets.along_surface) * across + same * (is_plane * targets.along_surface + (1 - is_plane));
    return shares.array() * all;
  };
  if (targets.along_surface == 1) return with_affine_part(basis, decoupled(rows, shares, displacement, stiffness));
  Eigen::MatrixXd matrix(3 * n, 3 * n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(3 * n);
  constexpr std::array<std::array<int, 2>, 6> blocks = {{{0, 0}, {1, 1}, {2, 2}, {1, 0}, {2, 0}, {2, 1}}};
  parallel_for_each(blocks.size(), [&](std::size_t i) {
    const auto [a, b] = blocks[i];
    matrix.block(a * n, b * n, n, n) = weighted_square(rows, cost(a, b));
  });
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b)
      right.segment(a * n, n) += rows.transpose() * cost(a, b).cwiseProduct(displacement.row(b).transpose());
    matrix.diagonal().segment(a * n + 4, n - 4).array() += stiffness;
    matrix.diagonal().segment(a * n, 4).array() += least_stiffness;
  }
  const Eigen::VectorXd solution = cholesky(matrix).solve(right);
  Eigen::MatrixXd coefficients(n, 3);
  for (int a = 0; a < 3; ++a) coefficients.col(a) = solution.segment(a * n, n);
  return with_affine_part(basis, coefficients);
}

}  // namespace gracilis
