#include <gracilis/geometry/radial_solid.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/rbf_centers.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/vertex_normals.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gracilis {

namespace {

struct Samples {
  Points points;
  Eigen::VectorXd values;
  Index on_surface = 0;  ///< the first so many
};

/// Vertices, points beside every second one at a third of the band and at the band, inside and outside in turn, and a
/// Halton sequence in the box.
Samples samples_of(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box, Real band) {
  const Points normals = vertex_normals(mesh.vertices, mesh.faces);
  std::vector<Vec3> beside;
  constexpr std::array<Real, 4> offsets = {1.0 / 3, -1.0 / 3, 1, -1};
  for (Index v = 0; v < mesh.vertex_count(); v += 2)
    for (const std::size_t k : {static_cast<std::size_t>(v / 2 % 2), static_cast<std::size_t>(2 + v / 2 % 2)})
      beside.push_back(mesh.vertices.col(v) + offsets[k] * band * normals.col(v));
  const Points around = halton_centers(box, mesh.vertex_count() / 10 + 100);
  Samples samples;
  samples.on_surface = mesh.vertex_count();
  samples.points.resize(3, mesh.vertex_count() + static_cast<Index>(beside.size()) + around.cols());
  samples.points.leftCols(mesh.vertex_count()) = mesh.vertices;
  for (std::size_t i = 0; i < beside.size(); ++i)
    samples.points.col(mesh.vertex_count() + static_cast<Index>(i)) = beside[i];
  samples.points.rightCols(around.cols()) = around;
  samples.values = Eigen::VectorXd::Zero(samples.points.cols());
  const SignedDistance distance(mesh);
  parallel_for(static_cast<Index>(samples.points.cols()) - samples.on_surface, 64, [&](Index begin, Index end) {
    for (Index i = samples.on_surface + begin; i < samples.on_surface + end; ++i)
      samples.values[i] = leveled(distance.query(samples.points.col(i)).distance, band);
  });
  return samples;
}

}  // namespace

Real leveled(Real distance, Real band) { return band * std::tanh(distance / band); }

RadialSolid fit_solid(const TriangleMesh& surface, const RadialSolidSettings& settings) {
  const Eigen::AlignedBox3d tight = bounding_box(surface.vertices);
  const Vec3 margin = Vec3::Constant(2 * settings.band);
  const Eigen::AlignedBox3d box(tight.min() - margin, tight.max() + margin);
  const Samples samples = samples_of(surface, box, settings.band);
  const auto on_surface = static_cast<Index>(settings.surface_share * settings.centers);
  const Points on = spread_out(samples.points.leftCols(samples.on_surface), on_surface);
  const Points beside = spread_out(samples.points.rightCols(samples.points.cols() - samples.on_surface),
                                   settings.centers - static_cast<Index>(on.cols()));
  Points centers(3, on.cols() + beside.cols());
  centers << on, beside;
  const Real spacing = std::sqrt(surface_area(surface.vertices, surface.faces) / std::max<Real>(1, on.cols()));
  const Eigen::VectorXd reaches = Eigen::VectorXd::Constant(centers.cols(), settings.reach_in_spacings * spacing);
  return {
      fit_least_squares({settings.kernel, RadialPolynomial::linear}, centers, reaches, samples.points, samples.values),
      box, settings.band};
}

ImplicitSolid implicit_solid(const RadialSolid& solid) {
  return {[basis = solid.fit.basis](const Vec3& point) { return value_at(basis, point); }, solid.bounds};
}

}  // namespace gracilis
