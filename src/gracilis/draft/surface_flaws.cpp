#include <gracilis/draft/surface_flaws.hpp>

#include <gracilis/geometry/mesh_pieces.hpp>
#include <gracilis/geometry/self_crossings.hpp>
#include <gracilis/geometry/winding_number.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gracilis {
namespace {

/// Whether most of some vertices, spread over the piece, lie in the other one.
bool lies_in(const TriangleMesh& piece, const WindingNumber& other) {
  const Index step = 1 + piece.vertex_count() / 50;
  Index inside = 0, count = 0;
  for (Index v = 0; v < piece.vertex_count(); v += step, ++count)
    inside += std::abs(other.query(piece.vertices.col(v))) > 0.5;
  return 2 * inside > count;
}

Index nested_pieces(const TriangleMesh& surface) {
  const std::vector<TriangleMesh> pieces = pieces_of(surface);  // the largest first
  if (pieces.size() < 2) return 0;
  std::vector<WindingNumber> larger;
  Index nested = 0;
  for (const TriangleMesh& piece : pieces) {
    nested +=
        std::any_of(larger.begin(), larger.end(), [&](const WindingNumber& each) { return lies_in(piece, each); });
    larger.emplace_back(piece);
  }
  return nested;
}

}  // namespace

std::string flaws_of(const TriangleMesh& surface) {
  std::string flaws;
  if (const Index nested = nested_pieces(surface); nested > 0)
    flaws = fmt::format("{} in another", nested == 1 ? "a closed piece lies" : "closed pieces lie");
  const std::vector<char> crossing =
      crossing_faces(TriangleTree(surface), surface, build_topology(surface.faces, surface.vertex_count()).edges);
  if (const auto count = std::count(crossing.begin(), crossing.end(), 1); count > 0)
    flaws += fmt::format("{}{} triangles cut others", flaws.empty() ? "" : ", ", count);
  return flaws;
}

}  // namespace gracilis
