#include <gracilis/methods/xpbd/fiber_directions.hpp>

#include <gracilis/geometry/harmonic_field.hpp>
#include <gracilis/geometry/measures.hpp>

namespace gracilis::xpbd {

/// The mean over an edge's two triangles.
static Vec3 direction_at(const MeshEdge& edge, const Points& directions) {
  Vec3 sum = Vec3::Zero();
  if (edge.left >= 0) sum += directions.col(edge.left);
  if (edge.right >= 0) sum += directions.col(edge.right);
  const Real length = sum.norm();
  return length > 0 ? Vec3(sum / length) : Vec3(Vec3::Zero());
}

Points fiber_directions(const Points& vertices, const Eigen::Matrix3Xi& faces, const MeshTopology& topology,
                        const std::vector<Attachment>& attachments) {
  std::vector<Index> fixed;
  std::vector<Real> values;
  bool has_origin = false, has_insertion = false;
  for (const Attachment& attachment : attachments) {
    const bool is_insertion = attachment.end == AttachmentEnd::insertion;
    (is_insertion ? has_insertion : has_origin) = true;
    for (Index v : attachment.vertices) fixed.push_back(v), values.push_back(is_insertion ? 1 : 0);
  }
  Points directions = Points::Zero(3, faces.cols());
  if (!has_origin || !has_insertion) return directions;
  const Eigen::Map<const Eigen::VectorXd> given(values.data(), static_cast<Index>(values.size()));
  const Eigen::VectorXd coordinate = harmonic_fields(vertices, topology, fixed, given).col(0);
  directions = face_gradients(vertices, faces, coordinate);
  for (Index f = 0; f < directions.cols(); ++f) {
    const Real length = directions.col(f).norm();
    // Inside an attachment the coordinate is constant and the gradient only rounding.
    directions.col(f) = length > 1e-6 ? Vec3(directions.col(f) / length) : Vec3(Vec3::Zero());
  }
  return directions;
}

Points edge_fiber_directions(const TriangleMesh& surface, const MeshTopology& topology,
                             const std::vector<Attachment>& attachments, const NearestFiber& fibers) {
  const Points& x = surface.vertices;
  const Points on_faces = fibers.any() ? Points() : fiber_directions(x, surface.faces, topology, attachments);
  Points directions(3, static_cast<Index>(topology.edges.size()));
  for (Index e = 0; e < static_cast<Index>(directions.cols()); ++e) {
    const MeshEdge& edge = topology.edges[static_cast<std::size_t>(e)];
    directions.col(e) =
        fibers.any() ? fibers.direction((x.col(edge.a) + x.col(edge.b)) / 2) : direction_at(edge, on_faces);
  }
  return directions;
}

}  // namespace gracilis::xpbd
