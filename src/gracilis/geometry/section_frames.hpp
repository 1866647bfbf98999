#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// Sections across a line, 3 × n points from its beginning to its end (Laclé 2014, chapter 3).

/// The line with every part halved `scaling` times: 2^scaling (via points + 1) + 1 points, among them all given ones
/// (Laclé 2014, eq. 3.19). `scaling` from 0 to 16; at least two points.
Points subdivide_line(const Points& line, int scaling);

/// Which way the plane of a section looks (Laclé 2014, Figure 3.9): down, whatever the line does (a), along the part of
/// the line behind it (b), along the difference of its neighbors (c, which the publication chose).
enum class SectionPlanes { fixed, forward, centered };

/// The directions across the line: a column per section. The plane's normal is, centered, the difference of the
/// neighboring points (at the ends, of the end and its neighbor), forward, that of the next point and the section's own
/// (at the end, of the last two), and fixed, (0, -1, 0); the first ray is `first` in the first section's plane, carried
/// on from section to section by the smallest rotation that takes one normal to the next.
struct SectionFrames {
  Eigen::Matrix3Xd normals, first_rays;  ///< unit

  /// Ray `ray` of `rays` of section `k`, unit; they turn about the normal from the first one.
  Vec3 ray(Eigen::Index k, Eigen::Index ray, Eigen::Index rays) const;

  /// First ray, the direction across it in the plane, and the normal of section `k` as columns.
  Eigen::Matrix3d axes(Eigen::Index k) const;
};

/// Neighboring points of the line must not coincide. Where `first` is along the first normal, another is chosen.
SectionFrames section_frames(const Points& line, const Vec3& first, SectionPlanes planes = SectionPlanes::centered);

}  // namespace gracilis
