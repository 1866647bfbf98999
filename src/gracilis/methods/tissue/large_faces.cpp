#include <gracilis/methods/tissue/large_faces.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::tissue {

namespace {

/// Triangles whose longest edge is longer than this are large.
constexpr Real large_in_cells = 0.5;
/// Along an edge: more tell no more of a mean.
constexpr int most_pieces = 8;

Vec3 place_of(const TriangleMesh& surface, Index face, const Vec3& shares) {
  Vec3 sum = Vec3::Zero();
  for (Index k = 0; k < 3; ++k) sum += shares[k] * surface.vertices.col(surface.faces(k, face));
  return sum;
}

/// The mean over each of the equal triangles that a face falls into is that of its edges' middles, exact for squares.
void add_places(const TriangleMesh& surface, const Lattice& lattice, Index face, int pieces, LargeFaces& found) {
  const auto add = [&](Real i, Real j) {
    const Vec3 shares = Vec3(pieces - i - j, i, j) / pieces;
    const EmbeddedPoint at = embed(lattice, place_of(surface, face, shares));
    // A triangle may cut the corner of a cell that is none: there it counts as flat.
    if (at.cell >= 0) found.places.push_back({shares, at, 1.0 / (3 * pieces * pieces)});
  };
  const auto add_triangle = [&](Real i, Real j, Real to) {
    add(i + to / 2, j), add(i, j + to / 2), add(i + to / 2, j + to / 2);
  };
  const auto begin = static_cast<Index>(found.places.size());
  for (int i = 0; i < pieces; ++i)
    for (int j = 0; i + j < pieces; ++j) {
      add_triangle(i, j, 1);
      if (i + j + 1 < pieces) add_triangle(i + 1, j + 1, -1);
    }
  found.faces.back().places_begin = begin;
  found.faces.back().places_end = static_cast<Index>(found.places.size());
}

/// The middles of edges among them.
void keep_places(const TriangleMesh& surface, Index face, int pieces, LargeFaces& found) {
  const Eigen::Vector3i corners = surface.faces.col(face);
  const int parts = 2 * ((pieces + 1) / 2);
  found.faces.back().kept_begin = static_cast<Index>(found.kept.size());
  for (int i = 0; i <= parts; ++i)
    for (int j = 0; i + j <= parts; ++j)
      if (std::max({i, j, parts - i - j}) < parts)
        found.kept.push_back({{corners[0], corners[1], corners[2]}, Vec3(parts - i - j, i, j) / parts});
  found.faces.back().kept_end = static_cast<Index>(found.kept.size());
}

}  // namespace

LargeFaces find_large_faces(const TriangleMesh& surface, const std::vector<char>& is_free, const Lattice& lattice) {
  LargeFaces found;
  for (Index f = 0; f < surface.face_count(); ++f) {
    const Eigen::Vector3i corners = surface.faces.col(f);
    Real longest = 0;
    Index free_corner = -1;
    for (Index k = 0; k < 3; ++k) {
      if (is_free[static_cast<std::size_t>(corners[k])]) free_corner = corners[k];
      longest =
          std::max(longest, (surface.vertices.col(corners[k]) - surface.vertices.col(corners[(k + 1) % 3])).norm());
    }
    const int pieces =
        std::min(most_pieces, static_cast<int>(std::ceil(longest / (large_in_cells * lattice.cell_size))));
    if (free_corner < 0 || pieces < 2) continue;
    found.faces.push_back({.face = f, .free_corner = free_corner});
    add_places(surface, lattice, f, pieces, found);
    keep_places(surface, f, pieces, found);
  }
  return found;
}

}  // namespace gracilis::tissue
