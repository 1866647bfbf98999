#include <gracilis/prepare/rebuilding.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_pieces.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/surface_extraction.hpp>
#include <gracilis/geometry/winding_number.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gracilis {

static constexpr Real most_nodes = 3e6;  ///< of a grid: some 150 MB with what extraction needs

/// Fine enough for the shape, coarse enough for the memory.
static Real step_for(const Eigen::AlignedBox3d& box) {
  const Vec3 size = box.sizes().cwiseMax(0.02 * box.diagonal().norm());
  return std::max(box.diagonal().norm() / 250, std::cbrt(size.prod() / most_nodes));
}

TriangleMesh rebuilt_as_solid(const TriangleMesh& mesh, const TimeLimit& limit) {
  const NearestTriangle nearest(mesh);
  const WindingNumber winding(mesh);
  ImplicitSolid solid;
  solid.bounds = bounding_box(mesh.vertices);
  const Real step = step_for(solid.bounds);
  if (!(step > 0)) return {};
  solid.distance = [&](const Vec3& p) {
    limit.check();
    // Never zero: a wall inside of the solid is no surface of it.
    const Real distance = std::max(nearest.query(p).distance, 1e-6 * step);
    return solid.bounds.contains(p) && winding.query(p) > 0.5 ? -distance : distance;
  };
  std::vector<TriangleMesh> pieces = pieces_of(extract_surface(sample(solid, step)));
  std::erase_if(pieces, [&](const TriangleMesh& piece) {
    // Thinner than the grid: such sheets come of rounding about flat triangles. Bubbles within others go, too.
    const Real volume = enclosed_volume(piece.vertices, piece.faces);
    return !(volume > 0.5 * step * surface_area(piece.vertices, piece.faces));
  });
  return merged(pieces);
}

}  // namespace gracilis
