#include <gracilis/prepare/slivers.hpp>

#include <gracilis/geometry/mesh_repair.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/needles.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/cut_and_fill.hpp>
#include <gracilis/prepare/solids.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace gracilis {
namespace {

constexpr std::array<Real, 3> shortest_of_even = {0.15, 0.03, 0.006};  ///< of an even edge, in turn
constexpr int sliver_rounds = 6;

Real shortest_edge_of(const TriangleMesh& mesh, Index face) {
  const Eigen::Vector3i corners = mesh.faces.col(face);
  Real least = std::numeric_limits<Real>::infinity();
  for (int k = 0; k < 3; ++k)
    least = std::min(least, (mesh.vertices.col(corners[k]) - mesh.vertices.col(corners[(k + 1) % 3])).norm());
  return least;
}

Real length_of_shortest_edge(const TriangleMesh& mesh) {
  Real least = std::numeric_limits<Real>::infinity();
  for (Index f = 0; f < mesh.face_count(); ++f) least = std::min(least, shortest_edge_of(mesh, f));
  return least;
}

/// Marks the vertices within `reach` of where the other surface cuts itself.
void keep_where_cut(const TriangleMesh& other, const std::vector<char>& cuts, const TriangleMesh& mesh, Real reach,
                    std::vector<char>& kept) {
  std::vector<Index> chosen;
  for (Index f = 0; f < other.face_count(); ++f)
    if (cuts[static_cast<std::size_t>(f)]) chosen.push_back(f);
  const TriangleMesh cut{other.vertices, other.faces(Eigen::all, chosen)};
  const NearestTriangle nearest(cut);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (nearest.query(mesh.vertices.col(v)).distance < reach) kept[static_cast<std::size_t>(v)] = 1;
}

/// Collapses edges shorter than `shortest` but where the surface would cut itself then.
void collapse_slivers(TriangleMesh& mesh, Real shortest, const TimeLimit& limit) {
  std::vector<char> kept(static_cast<std::size_t>(mesh.vertex_count()), 0);
  for (int round = 0; round < sliver_rounds; ++round) {
    std::optional<TriangleMesh> even = without_slivers(mesh, shortest, kept);
    if (!even) return;
    *even = repair_mesh(*even).mesh;
    if (!is_solid(*even)) return;
    const std::vector<char> cuts = faces_that_cut(*even, limit);
    if (std::find(cuts.begin(), cuts.end(), 1) == cuts.end()) {
      mesh = std::move(*even);
      return;
    }
    keep_where_cut(*even, cuts, mesh, (round + 1) * shortest, kept);
  }
}

/// Cuts out what is at edges that no collapse could take away, and fills the holes.
void cut_slivers_out(TriangleMesh& mesh, Real shortest, const TimeLimit& limit) {
  std::vector<char> at_slivers(static_cast<std::size_t>(mesh.face_count()), 0);
  for (Index f = 0; f < mesh.face_count(); ++f)
    at_slivers[static_cast<std::size_t>(f)] = shortest_edge_of(mesh, f) < shortest;
  TriangleMesh other = mesh;
  if (cut_and_fill(other, at_slivers, 0, limit) && length_of_shortest_edge(other) > length_of_shortest_edge(mesh))
    mesh = std::move(other);
}

}  // namespace

void drop_slivers(TriangleMesh& mesh, const TimeLimit& limit) {
  const Real even = even_edge(mesh);
  for (const Real share : shortest_of_even)
    if (length_of_shortest_edge(mesh) < share * even) collapse_slivers(mesh, share * even, limit);
  const Real shortest = shortest_of_even[1] * even;
  if (length_of_shortest_edge(mesh) < shortest) cut_slivers_out(mesh, shortest, limit);
}

}  // namespace gracilis
