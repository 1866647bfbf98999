#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

namespace gracilis {

/// A muscle as polygons across its action line (Laclé 2014, chapter 3): section k has its center at point k of the line
/// and a vertex on each of its rays. Vertices are numbered section by section, ray by ray; then come the centers of the
/// first and the last section, which close the surface.

/// The directions across the line: a column per section. The plane's normal is the difference of the neighboring points
/// (at the ends, of the end and its neighbor); the first ray is `first` in the first section's plane, carried on from
/// section to section by the smallest rotation that takes one normal to the next.
struct SectionFrames {
  Eigen::Matrix3Xd normals, first_rays;  ///< unit

  /// Ray `ray` of `rays` of section `k`, unit; they turn about the normal from the first one.
  Vec3 ray(Eigen::Index k, Eigen::Index ray, Eigen::Index rays) const;
};

/// Neighboring points of the line must not coincide. Where `first` is along the first normal, another is chosen.
SectionFrames section_frames(const Points& line, const Vec3& first);

/// Vertices for `radii` (rays × sections, m).
Points section_vertices(const Points& line, const SectionFrames& frames, const Eigen::MatrixXd& radii);

/// Triangles of `sections` polygons with `rays` corners, oriented outwards.
Eigen::Matrix3Xi section_faces(Index sections, Index rays);

}  // namespace gracilis
