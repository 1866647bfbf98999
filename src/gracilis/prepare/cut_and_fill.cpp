#include <gracilis/prepare/cut_and_fill.hpp>

#include <gracilis/geometry/mesh_repair.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/solids.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <vector>

namespace gracilis {
namespace {

constexpr int most_cuts = 5;
constexpr Real most_of_it = 0.5;  ///< of the triangles may go in one cut; more is no mending

/// Tells whether enough is left.
bool cut_out(TriangleMesh& mesh, const std::vector<char>& chosen) {
  Index kept = 0;
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (!chosen[static_cast<std::size_t>(f)]) mesh.faces.col(kept++) = Eigen::Vector3i(mesh.faces.col(f));
  const bool enough = Real(kept) > (1 - most_of_it) * Real(mesh.face_count());
  mesh.faces.conservativeResize(3, kept);
  return enough;
}

}  // namespace

std::vector<char> faces_that_cut(const TriangleMesh& mesh, const TimeLimit& limit) {
  std::vector<char> bad(static_cast<std::size_t>(mesh.face_count()), 0);
  const std::array<const TriangleMesh*, 1> one = {&mesh};
  for (const FacePair& pair : intersecting_faces(one, false, limit))
    bad[static_cast<std::size_t>(pair.face_a)] = bad[static_cast<std::size_t>(pair.face_b)] = 1;
  return bad;
}

void widen(const TriangleMesh& mesh, std::vector<char>& chosen) {
  std::vector<char> touched(static_cast<std::size_t>(mesh.vertex_count()), 0);
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (chosen[static_cast<std::size_t>(f)])
      for (const Index v : mesh.faces.col(f)) touched[static_cast<std::size_t>(v)] = 1;
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (const Index v : mesh.faces.col(f))
      if (touched[static_cast<std::size_t>(v)]) chosen[static_cast<std::size_t>(f)] = 1;
}

bool cut_and_fill(TriangleMesh& mesh, Real crumb_share, const TimeLimit& limit) {
  return cut_and_fill(mesh, {}, crumb_share, limit);
}

bool cut_and_fill(TriangleMesh& mesh, const std::vector<char>& chosen, Real crumb_share, const TimeLimit& limit) {
  for (int cut = 0; cut <= most_cuts; ++cut) {
    limit.check();
    std::vector<char> bad = faces_that_cut(mesh, limit);
    if (cut == 0 && !chosen.empty())
      std::transform(bad.begin(), bad.end(), chosen.begin(), bad.begin(), std::bit_or<>());
    if (std::find(bad.begin(), bad.end(), 1) == bad.end()) return is_solid(inspect_mesh(mesh));
    if (cut == most_cuts) return false;
    for (int ring = 0; ring < cut; ++ring) widen(mesh, bad);
    if (!cut_out(mesh, bad)) return false;
    mesh = repair_mesh(manifold_of_soup(mesh), crumb_share).mesh;
    if (mesh.face_count() == 0) return false;
    // A fair patch follows its surroundings; where that failed a flat one has more room.
    fill_holes(mesh, std::numeric_limits<Real>::max(), cut < 3, limit);
    mesh = repair_mesh(mesh, crumb_share).mesh;
    if (!is_solid(inspect_mesh(mesh))) return false;
  }
  return false;
}

}  // namespace gracilis
