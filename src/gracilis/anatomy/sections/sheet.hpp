#pragma once

#include <gracilis/anatomy/sections/line_sections.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

namespace gracilis {

/// One surface over the lines of several heads of a muscle. Section k joins the heads' own sections k: its corners go
/// around the last head, along one side to the first head, around that and back along the other side. Numbered as those
/// of a single line (cylinder_surface.hpp): section by section, corner 0 at the last head's edge; then a vertex in the
/// middle of each end, which is closed from side to side.

/// Where a corner lies: between two heads, and around them.
struct SheetCorner {
  std::size_t head = 0;  ///< the one before it
  Real next = 0;         ///< share of the way to the next, 0 to 1
  Real angle = 0;        ///< rad; from the direction that leads from the first head to the last
};

/// Corners are at equal angles, 2 π over their number; `side` parts lie between the outer heads on each side, evenly. A
/// corner that is no whole number lies between two. Preconditions: two heads or more, 1 <= side < rays / 2.
SheetCorner sheet_corner(Index rays, Index side, std::size_t heads, Real corner);

/// The corner on the other side of the sheet; those at its edges are their own.
Index opposite_corner(Index rays, Index corner);

/// Triangles of a sheet with so many sections, oriented outwards.
Eigen::Matrix3Xi sheet_faces(Index sections, Index rays);

/// With the vertices that close the ends, for those of the sections.
Points sheet_vertices(const Points& corners, Index rays);

/// What of a muscle's vertices the heads carry, or the only line does.
struct LineShare {
  Index section = 0;     ///< of each line
  std::size_t line = 0;  ///< that carries it, with
  Real next = 0;         ///< this share left to the next one
};

/// The sections of each head's line, or of the muscle's only one. Precondition: it has an action line.
std::vector<LineSections> carrying_lines(const Muscle& muscle);

/// Of each vertex of the surface that was made for these lines.
std::vector<LineShare> line_shares(const ActionLine& line, Index vertices);

/// Of any other point: by the nearest section of the lines' (`centers`, of each), and the nearest place between them.
LineShare nearest_share(const std::vector<Points>& centers, const Vec3& point);

/// Of each vertex of a muscle's surface, which may be a finer or coarser copy. `centers`: as above.
std::vector<LineShare> vertex_shares(const Muscle& muscle, const std::vector<Points>& centers);

/// Which of what has these shares lies in tendons, of all lines that carry it.
std::vector<char> in_tendons(const std::vector<LineSections>& lines, const std::vector<LineShare>& shares);

/// The same of a muscle's vertices; empty where it has no line.
std::vector<char> in_tendons(const Muscle& muscle);

}  // namespace gracilis
