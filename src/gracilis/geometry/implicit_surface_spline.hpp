#pragma once

#include <gracilis/geometry/implicit_surface.hpp>

#include <array>
#include <vector>

namespace gracilis {

/// The Catmull-Rom spline through `points`, cut into `pieces` per interval; ends as straight as the first and last
/// interval. Radii are interpolated alike but kept positive. (Catmull and Rom 1974, uniform parametrization.)
std::vector<ThickPoint> spline_through(const std::vector<ThickPoint>& points, int pieces);

/// A net of control points: `columns` curves side by side, each of `rows` points. Point (row, column) is
/// points[row * columns + column].
struct ThickNet {
  int rows = 0;
  int columns = 0;
  std::vector<ThickPoint> points;
};

/// A surface patch given a thickness: the balls swept over the surface that the Catmull-Rom splines along rows and
/// columns span.
class ThickSheet {
 public:
  /// Prepares queries; `net` has at least 2 rows and 2 columns. Each interval is cut into `pieces`.
  explicit ThickSheet(const ThickNet& net, int pieces = 4);

  struct Nearest {
    Real distance = 0;  ///< m, negative inside
    Real along = 0;     ///< 0 at the first row, 1 at the last
    Real across = 0;    ///< 0 at the first column, 1 at the last
  };
  /// How far a point (m) is from the sheet, and where on it.
  Nearest nearest(const Vec3& point) const;
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }  ///< m

 private:
  /// A ball that contains a part of the sheet with its thickness.
  struct Reach {
    Vec3 center = Vec3::Zero();
    Real radius = 0;
    Real least_distance(const Vec3& point) const { return (point - center).norm() - radius; }
  };
  /// Two triangles (a b c, c b d) of the cut sheet.
  struct Quad {
    std::array<int, 4> corners;
    Reach reach;
  };
  /// The quads of one interval of the net: what is too far as a whole is skipped as a whole.
  struct Patch {
    std::vector<Quad> quads;
    Reach reach;
  };
  Reach reach_of(const std::vector<int>& points) const;
  void search(const Patch& patch, const Vec3& point, Nearest& best) const;

  std::vector<ThickPoint> points_;
  std::vector<Patch> patches_;
  int rows_ = 0;
  int columns_ = 0;
  Eigen::AlignedBox3d bounds_;
};

/// The sheet as a solid.
ImplicitSolid thick_sheet(const ThickNet& net);

}  // namespace gracilis
