#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/cgal_mesh.hpp>
#include <gracilis/prepare/solids.hpp>

#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>

#include <exception>

namespace gracilis {

std::optional<TriangleMesh> without_slivers(const TriangleMesh& mesh, Real shortest, const std::vector<char>& kept) {
  constexpr Real needle_ratio = 1.5;  // of a triangle's longest edge to its shortest, which is then collapsed
  constexpr Real no_cap = -1;  // cosine of the widest angle: a flip where the surface folds would make it cut itself
  if (!bounds_a_solid(inspect_mesh(mesh))) return std::nullopt;
  std::optional<CgalMesh> given = to_cgal(mesh);
  if (!given) return std::nullopt;
  auto is_kept = given->add_property_map<CgalMesh::Vertex_index, bool>("v:is_kept", false).first;
  for (const auto v : given->vertices()) is_kept[v] = kept[static_cast<std::size_t>(v)];
  try {
    CGAL::Polygon_mesh_processing::experimental::remove_almost_degenerate_faces(
        given->faces(), *given, no_cap, needle_ratio, shortest, CGAL::parameters::vertex_is_constrained_map(is_kept));
    given->collect_garbage();
    return from_cgal(*given);
  } catch (const std::exception&) {
    return std::nullopt;  // CGAL says that it cannot
  }
}

}  // namespace gracilis
