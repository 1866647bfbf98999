#include <gracilis/geometry/symmetry_plane.hpp>

#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/principal_axes.hpp>
#include <gracilis/geometry/surface_samples.hpp>

#include <cmath>

namespace gracilis {

SymmetryPlane symmetry_plane(const TriangleMesh& mesh, const Vec3& about) {
  constexpr Index most_samples = 600;
  constexpr int most_rounds = 40;
  constexpr Real settled = radians(0.01);
  const SurfaceSamples all = surface_samples(mesh);
  const Index step = 1 + all.count() / most_samples;
  const SurfaceSamples samples = all.kept([&](Index i) { return i % step == 0; });
  SymmetryPlane plane{mesh.vertices.rowwise().mean(), about, 0};
  if (samples.count() == 0) return plane;
  const NearestTriangle surface(mesh);
  const Real area = samples.areas.sum();
  const Vec3 middle = samples.points * samples.areas / area;
  plane.point = middle;
  for (int round = 0; round < most_rounds; ++round) {
    Points mirrored(3, samples.count());
    Real squares = 0;
    for (Index i = 0; i < samples.count(); ++i) {
      const Vec3 p = samples.points.col(i);
      const NearestPoint nearest = surface.query(p - 2 * (p - plane.point).dot(plane.normal) * plane.normal);
      mirrored.col(i) = nearest.point;
      squares += samples.areas[i] * nearest.distance * nearest.distance;
    }
    plane.misfit = std::sqrt(squares / area);
    const Vec3 middle_mirrored = mirrored * samples.areas / area;
    const Eigen::Matrix3d covariance = (samples.points.colwise() - middle) * samples.areas.asDiagonal() *
                                       (mirrored.colwise() - middle_mirrored).transpose();
    Vec3 normal = principal_axes(covariance + covariance.transpose()).least();
    if (normal.dot(plane.normal) < 0) normal = -normal;
    const bool is_settled = normal.dot(plane.normal) > std::cos(settled);
    plane.normal = normal;
    plane.point = (middle + middle_mirrored) / 2;
    if (is_settled) break;
  }
  return plane;
}

}  // namespace gracilis
