#include <gracilis/anatomy/resolution/coarser_muscle.hpp>

#include <gracilis/geometry/decimation.hpp>
#include <gracilis/geometry/measures.hpp>

#include <cmath>

namespace gracilis {

/// So many vertices cover a surface with equilateral triangles of this edge length.
static Index vertices_for(const TriangleMesh& surface, Real edge_length) {
  if (!(edge_length > 0)) return surface.vertex_count();
  const Real area = vertex_areas(surface.vertices, surface.faces).sum();
  return static_cast<Index>(std::ceil(area / (std::sqrt(Real{3}) / 2 * edge_length * edge_length)));
}

CoarserMuscle coarser_muscle(const Muscle& muscle, Real edge_length) {
  std::vector<Index> body(static_cast<std::size_t>(muscle.surface.vertex_count()), -1);
  for (const Attachment& attachment : muscle.attachments)
    for (const Index v : attachment.vertices) body[static_cast<std::size_t>(v)] = attachment.body;
  CoarseSurface coarse = decimate(muscle.surface, vertices_for(muscle.surface, edge_length), body);

  CoarserMuscle result{muscle, std::move(coarse.vertices), std::move(coarse.went_to)};
  result.muscle.surface = {picked(muscle.surface.vertices, result.vertices), std::move(coarse.faces)};
  std::vector<Index> number(body.size(), -1);
  for (std::size_t i = 0; i < result.vertices.size(); ++i)
    number[static_cast<std::size_t>(result.vertices[i])] = static_cast<Index>(i);
  for (Attachment& attachment : result.muscle.attachments) {
    std::vector<Index> left;
    for (const Index v : attachment.vertices)
      if (number[static_cast<std::size_t>(v)] >= 0) left.push_back(number[static_cast<std::size_t>(v)]);
    attachment.vertices = std::move(left);
  }
  return result;
}

}  // namespace gracilis
