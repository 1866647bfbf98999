#include <gracilis/geometry/area_samples.hpp>

#include <gracilis/geometry/halton.hpp>
#include <gracilis/geometry/measures.hpp>

#include <cmath>

namespace gracilis {

Points AreaSamples::points(const Points& vertices, const Eigen::Matrix3Xi& of_faces) const {
  Points result = Points::Zero(3, count());
  for (Index i = 0; i < count(); ++i)
    for (int k = 0; k < 3; ++k)
      result.col(i) += shares(k, i) * vertices.col(of_faces(k, faces[static_cast<std::size_t>(i)]));
  return result;
}

Points AreaSamples::normals(const Points& vertices, const Eigen::Matrix3Xi& of_faces) const {
  Points result(3, count());
  for (Index i = 0; i < count(); ++i)
    result.col(i) = area_vector(vertices, of_faces.col(faces[static_cast<std::size_t>(i)])).normalized();
  return result;
}

AreaSamples area_samples(const TriangleMesh& mesh, Index count) {
  const Eigen::MatrixXd halton = halton_points(count, 2);
  AreaSamples samples{{}, Points(3, count)};
  samples.faces.reserve(static_cast<std::size_t>(count));
  const Real step = surface_area(mesh.vertices, mesh.faces) / count;
  Real passed = 0;
  Index face = 0;
  const auto area = [&](Index f) { return area_vector(mesh.vertices, mesh.faces.col(f)).norm() / 2; };
  for (Index i = 0; i < count; ++i) {
    while (face + 1 < mesh.face_count() && passed + area(face) < (i + 0.5) * step) passed += area(face++);
    samples.faces.push_back(face);
    // Uniform in the triangle (Osada et al. 2002).
    const Real root = std::sqrt(halton(i, 0)), other = halton(i, 1);
    samples.shares.col(i) = Vec3(1 - root, root * (1 - other), root * other);
  }
  return samples;
}

}  // namespace gracilis
