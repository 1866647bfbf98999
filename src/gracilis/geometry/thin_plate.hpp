#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// Smooth maps of space, \f$x \mapsto A x + t + \sum_k w_k |x - c_k|\f$ with weights that no affine map sees: the
/// splines that bend least in three dimensions (Duchon 1977), whose bending is zero for affine maps alone.
class ThinPlateBasis {
 public:
  /// No centers: affine maps alone. Preconditions otherwise: five centers or more, no two at one place, not all in a
  /// plane.
  explicit ThinPlateBasis(const Points& centers);

  /// Affine functions (4), then bending ones that are orthonormal in their bending, of places in units of `size`.
  Index count() const { return 4 + static_cast<Index>(bending_.cols()); }
  /// Their values at points: a row each.
  Eigen::MatrixXd rows(const Points& points) const;
  /// As kernels about the centers and affine functions: what an evaluation takes. (centers + 4) × k of count × k.
  Eigen::MatrixXd kernel_weights(const Eigen::MatrixXd& coefficients) const;

  const Points& centers() const { return centers_; }  ///< m
  Real size() const { return size_; }                 ///< m: the unit of places in the functions
  const Vec3& origin() const { return origin_; }      ///< m: where these places are counted from

 private:
  Points centers_;
  Vec3 origin_ = Vec3::Zero();
  Real size_ = 1;
  Eigen::MatrixXd bending_;  ///< centers × functions
};

/// One such map.
class ThinPlateMap {
 public:
  ThinPlateMap() = default;  ///< identity
  /// `coefficients`: count × 3 of the basis, m.
  ThinPlateMap(const ThinPlateBasis& basis, const Eigen::MatrixXd& coefficients);
  static ThinPlateMap affine(const Eigen::Matrix3d& linear, const Vec3& shift);  ///< x ↦ linear x + shift (m)

  Vec3 at(const Vec3& p) const;           ///< where a point comes to, m
  Points at(const Points& points) const;  ///< where points come to, m: 3 × n
  /// ∂ at(p) / ∂ p.
  Eigen::Matrix3d slope(const Vec3& p) const;

 private:
  Points centers_ = Points(3, 0), weights_ = Points(3, 0);
  Eigen::Matrix3d linear_ = Eigen::Matrix3d::Identity();
  Vec3 shift_ = Vec3::Zero();
};

/// Points that should come to places: each costs its weight times the squared distance, as far as it is along the
/// normal, and `along_surface` times that across it. Normals of zero count all directions alike.
struct PlaceTargets {
  Points points, places, normals;
  Eigen::VectorXd weights;
  Real along_surface = 1;
};

/// The map where the weighted mean of these costs, in units of the basis' size, plus `stiffness` times the bending is
/// least; bending is that of the displacement, and affine parts cost nothing. Precondition: some weight is above 0.
ThinPlateMap fit_thin_plate(const ThinPlateBasis& basis, const PlaceTargets& targets, Real stiffness);

}  // namespace gracilis
