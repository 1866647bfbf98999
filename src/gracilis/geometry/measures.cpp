#include <gracilis/geometry/measures.hpp>

#include <cmath>

namespace gracilis {

Eigen::AlignedBox3d bounding_box(const Points& points) {
  return {points.rowwise().minCoeff(), points.rowwise().maxCoeff()};
}

Real extent_of(const Points& points) {
  return std::sqrt((points.colwise() - points.rowwise().mean()).colwise().squaredNorm().mean());
}

Vec3 area_vector(const Points& vertices, const Eigen::Vector3i& corners) {
  const Vec3 a = vertices.col(corners[0]);
  return (vertices.col(corners[1]) - a).cross(vertices.col(corners[2]) - a);
}

Real area_at(const MeshEdge& edge, const Points& vertices, const Eigen::Matrix3Xi& faces) {
  Real area = 0;
  for (const Index face : {edge.left, edge.right})
    if (face >= 0) area += area_vector(vertices, faces.col(face)).norm() / 2;
  return area;
}

Real mean_edge_length(const std::vector<MeshEdge>& edges, const Points& vertices) {
  Real sum = 0;
  for (const MeshEdge& edge : edges) sum += (vertices.col(edge.a) - vertices.col(edge.b)).norm();
  return edges.empty() ? 0 : sum / static_cast<Real>(edges.size());
}

Real enclosed_volume(const Points& vertices, const Eigen::Matrix3Xi& faces) {
  if (vertices.cols() == 0) return 0;
  const Vec3 origin = vertices.col(0);
  Real six_volumes = 0;
  for (Index face = 0; face < faces.cols(); ++face) {
    const Vec3 a = vertices.col(faces(0, face)) - origin, b = vertices.col(faces(1, face)) - origin,
               c = vertices.col(faces(2, face)) - origin;
    six_volumes += a.dot(b.cross(c));
  }
  return six_volumes / 6;
}

Real surface_area(const Points& vertices, const Eigen::Matrix3Xi& faces) {
  Real area = 0;
  for (Index face = 0; face < faces.cols(); ++face) area += area_vector(vertices, faces.col(face)).norm() / 2;
  return area;
}

Eigen::VectorXd vertex_areas(const Points& vertices, const Eigen::Matrix3Xi& faces) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(vertices.cols());
  for (Index face = 0; face < faces.cols(); ++face) {
    const Real third = area_vector(vertices, faces.col(face)).norm() / 6;
    for (int k = 0; k < 3; ++k) areas[faces(k, face)] += third;
  }
  return areas;
}

}  // namespace gracilis
