#include <gracilis/anatomy/sections/surface_slices.hpp>

#include <gracilis/anatomy/sections/section_cut.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/principal_axes.hpp>

namespace gracilis {

namespace {

/// The axis along which a surface is longest, and two across it.
Eigen::Matrix3d axes_of(const TriangleMesh& surface) {
  Real area = 0;
  Vec3 first = Vec3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const auto& face : surface.faces.colwise()) {
    const Real part = area_vector(surface.vertices, face).norm() / 2;
    const Vec3 center =
        (surface.vertices.col(face[0]) + surface.vertices.col(face[1]) + surface.vertices.col(face[2])) / 3;
    area += part;
    first += part * center;
    second += part / 12 * 9 * center * center.transpose();
    for (int k = 0; k < 3; ++k)
      second += part / 12 * surface.vertices.col(face[k]) * surface.vertices.col(face[k]).transpose();
  }
  const PrincipalAxes spread = principal_axes(second - first * first.transpose() / area);
  Eigen::Matrix3d axes;
  axes.col(2) = spread.directions.col(2);
  axes.col(0) = spread.directions.col(1);
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

/// Twice the signed area, and the centroid.
std::pair<Real, Eigen::Vector2d> area_and_centroid(const Eigen::Matrix2Xd& outline) {
  Real twice = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (Eigen::Index i = 0; i < outline.cols(); ++i) {
    const Eigen::Vector2d a = outline.col(i) - outline.col(0),
                          b = outline.col((i + 1) % outline.cols()) - outline.col(0);
    const Real part = a.x() * b.y() - a.y() * b.x();
    twice += part;
    sum += part * (a + b) / 3;
  }
  return {twice, twice != 0 ? Eigen::Vector2d(outline.col(0) + sum / twice) : Eigen::Vector2d(outline.col(0))};
}

SectionShape shape_of(const Eigen::Matrix2Xd& outline) {
  SectionRings ring{static_cast<Index>(outline.cols()), Points::Zero(3, 1), Points::Zero(3, outline.cols())};
  ring.corners.topRows(2) = outline;
  return section_shape(ring, 0);
}

}  // namespace

std::vector<SurfaceSlice> surface_slices(const TriangleMesh& surface, int count) {
  const Eigen::Matrix3d axes = axes_of(surface);
  const Eigen::RowVectorXd heights = axes.col(2).transpose() * surface.vertices;
  const Vec3 middle = surface.vertices.rowwise().mean();
  const Real low = heights.minCoeff(), high = heights.maxCoeff();
  std::vector<SurfaceSlice> slices;
  for (int k = 1; k <= count; ++k) {
    SurfaceSlice slice;
    slice.place = (high - low) * k / (count + 1);
    const Vec3 center = middle + (low + slice.place - axes.col(2).dot(middle)) * axes.col(2);
    Real largest = 0;
    for (const Eigen::Matrix2Xd& outline : SectionCut(surface, center, axes.col(0), axes.col(1)).outlines()) {
      ++slice.outlines;
      const auto [twice, centroid] = area_and_centroid(outline);
      if (twice <= largest) continue;
      largest = twice;
      slice.outline = outline.colwise() - centroid;
    }
    if (slice.outline.cols() > 0) slice.shape = shape_of(slice.outline);
    slices.push_back(std::move(slice));
  }
  return slices;
}

}  // namespace gracilis
