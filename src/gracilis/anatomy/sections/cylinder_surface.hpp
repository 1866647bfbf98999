#pragma once

#include <gracilis/geometry/section_frames.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

namespace gracilis {

/// A muscle as polygons across its action line (Laclé 2014, chapter 3): section k has its center at point k of the line
/// and a vertex on each of its rays. Vertices are numbered section by section, ray by ray; then come the centers of the
/// first and the last section, which close the surface.

/// Vertices for `radii` (rays × sections, m).
Points section_vertices(const Points& line, const SectionFrames& frames, const Eigen::MatrixXd& radii);

/// Triangles of `sections` polygons with `rays` corners, oriented outwards.
Eigen::Matrix3Xi section_faces(Index sections, Index rays);

}  // namespace gracilis
