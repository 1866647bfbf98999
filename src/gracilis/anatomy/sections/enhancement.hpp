#pragma once

#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/anatomy/sections/section_cut.hpp>

#include <vector>

namespace gracilis {

/// Sections brought onto a muscle's given surface (Laclé 2014, section 3.5).

/// One section's radii after rays were cast along them.
struct CastRadii {
  Eigen::VectorXd radii;    ///< m; negative where the point found lies beyond the center
  std::vector<bool> found;  ///< a ray has met the surface
};

/// Casts rays from the ends of the radii, outwards and, where these find nothing, inwards through the center and on:
/// outwards the farthest triangle met from behind counts, inwards the nearest one met from the front. `angles` (rad)
/// are the rays' in the plane.
CastRadii cast_radii(const SectionCut& cut, const Eigen::VectorXd& angles, const Eigen::VectorXd& radii);

/// A pair of opposite rays that met the surface on the same side of the center.
struct RayMatch {
  Index positive = 0, negative = 0;  ///< the ray on that side, and the one that passed through the center

  bool operator==(const RayMatch&) const = default;  ///< the same two rays
};

/// All matches, in the order in which they wind through the section: ascending and turned so that they begin behind the
/// largest gap.
std::vector<RayMatch> find_matches(const CastRadii& cast);

/// A point in the middle of what the matches span: the middle of the middle match, or the centroid of the
/// quadrilateral of the two middle ones. Plane coordinates. Precondition: one match at least.
Eigen::Vector2d inner_point(const std::vector<RayMatch>& matches, const Eigen::VectorXd& angles,
                            const Eigen::VectorXd& radii);

struct EnhancementSettings {
  int more_rays = 1;  ///< times as many rays as radii look for inner points (the publication's CSS)
  bool mend = true;   ///< where the published heuristic finds no point inside, another is looked for
  SectionPlanes planes = SectionPlanes::centered;
};

/// Where a match's two rays met the surface.
struct MatchedPoints {
  Index section = 0;
  Vec3 positive, negative;  ///< m
};

struct EnhancedSections {
  Points centers;
  SectionFrames frames;
  Eigen::MatrixXd radii;               ///< rays × sections, m, all positive
  std::vector<bool> cut;               ///< the section's plane cuts the surface
  std::vector<bool> inside;            ///< its center lies inside, at the ends before they went back
  std::vector<MatchedPoints> matches;  ///< by section, as find_matches orders them; those that its inner point is from
};

/// Moves the line's points inside the surface and the sections' corners onto it: rays along `more_rays` times as many
/// directions as there are radii find inner points, then the radii are cast from there. The ends go back to where they
/// were at last. Sections whose plane misses the surface keep center and radii. `line` are the sections' centers,
/// `first` the first ray (see section_frames), `radii` where they begin. With `mend`, where a section finds no match,
/// but its plane cuts the surface, rays are doubled until one meets it (up to 1152), and a point found outside goes to
/// the middle of the longest way inside; without, the center stays where nothing is found. Preconditions: closed
/// surface, an even number of rays, 6 or more.
EnhancedSections enhance(const Points& line, const Vec3& first, const Eigen::MatrixXd& radii,
                         const TriangleMesh& surface, const EnhancementSettings& settings = {});

}  // namespace gracilis
