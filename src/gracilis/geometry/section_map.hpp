#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/delaunay.hpp>

#include <array>
#include <optional>

namespace gracilis {

/// Where the unit square's corners (0,0), (1,0), (1,1), (0,1) lie on a closed line, as ascending shares of its length
/// from its first point; the first may be negative (before the first point).
using SquareCorners = std::array<Real, 4>;

/// Corners for a cross-section: the two sides that become short lie at its far ends along its principal direction, and
/// are as long as those of the rectangle of the same area and circumference. `aspect` gets long over short side.
SquareCorners square_corners(const Points& loop, Real& aspect);

/// A smooth one-to-one map from the unit square onto the spanning surface of a closed line. The line is laid into its
/// mean plane, its inside triangulated, and each inner vertex mapped into the square by a harmonic map with positive
/// weights, whose boundary goes around the square with the line's length; onto a convex boundary such a map is one to
/// one (Tutte 1963, Floater 1997), whatever the shape of the cross-section. Heights above the plane are harmonic, too.
class SectionMap {
 public:
  /// Empty when the line has no area or crosses itself in its mean plane. Shape of `loop`: 3 × n, m. Throws
  /// QualityError where the map has no solution.
  static std::optional<SectionMap> build(const Points& loop, const SquareCorners& corners);

  /// The point of the spanning surface at (a, b) in the unit square, m.
  Vec3 at(Real a, Real b) const;

  /// Where in the unit square the point of the spanning surface lies that is nearest to p (its nearest vertex).
  Eigen::Vector2d nearest(const Vec3& p) const;

 private:
  Eigen::Matrix3Xi triangles_;
  PlanePoints square_;  ///< per vertex: where it lies in the unit square
  Points points_;       ///< per vertex: where it lies in space
};

}  // namespace gracilis
