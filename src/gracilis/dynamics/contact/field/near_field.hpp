#pragma once

#include <gracilis/core/aligned.hpp>
#include <gracilis/dynamics/constraints/color_order.hpp>
#include <gracilis/dynamics/contact/field/field_contact_set.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace gracilis {

/// A particle in the obstacle's frame, and a lower bound of the distance there.
struct CachedQuery {
  Eigen::Vector3f place = Eigen::Vector3f::Zero();
  float distance = 0;
};

/// How many particles, or edges of one color, a task takes.
inline constexpr Index contacts_per_task = 512;

/// A field's slope may exceed 1 by rounding and interpolation.
inline constexpr float steepest = 1.1f;

/// Whether what was `seen` may have come down to `level` on its way to `q`.
inline bool may_reach(const CachedQuery& seen, const Eigen::Vector3f& q, float level) {
  const float left = seen.distance - level;
  return left <= 0 || steepest * steepest * (q - seen.place).squaredNorm() >= left * left;
}

/// The share of an edge or a face at an end or a corner that is not tested, where that cannot move: nothing can be
/// pushed out there without throwing the other end far away. More of it where a bone that it is not attached to has
/// come over that end, which is deeper than its gap.
inline float untested_share(bool movable, float clearance) {
  if (movable) return 0;
  return clearance < 0 ? 0.5f : 0.2f;
}

/// The gap at an end or a corner: its own; but where a bone has come over it and it cannot move, one by which what is
/// half way to the other end, with a gap of `other`, touches the bone and no more: each bit of gap there throws the
/// other end twice as far.
inline float gap_of_end(bool movable, float clearance, float gap, float other) {
  return movable || !(clearance < 0) ? gap : std::min(gap, -other);
}

/// Gradients shorter than this, squared, tell no way out: on a field's ridges they fade.
inline constexpr float least_slope2 = 1e-4f;

/// Edges near an obstacle, one per slot. Every color is padded to whole groups with edges between copies of the idle
/// particle.
struct NearEdges {
  AlignedVector<Index> a, b;                    ///< particles
  AlignedVector<float> gap_a, gap_b;            ///< m, that the ends keep, the edge's sag included
  AlignedVector<float> low, high;               ///< the part that is tested, 0 at a, 1 at b
  AlignedVector<float> t;                       ///< the deepest point, 0 at a, 1 at b; or unknown_point
  AlignedVector<float> seen_x, seen_y, seen_z;  ///< where it was when the obstacle was last asked, m,
  AlignedVector<float> seen_above;              ///< and how far above its gap at least, m
  std::vector<ColorRange> colors;

  Index count() const { return static_cast<Index>(a.size()); }  ///< of slots, padding included
};
inline constexpr float unknown_point = -1;  ///< nobody has looked yet; what was seen is that of the middle

/// Large faces near an obstacle.
struct NearFaces {
  std::vector<Index> slots;            ///< in the face set, grouped by color
  std::vector<Eigen::Vector3f> where;  ///< the deepest point, barycentric
  std::vector<float> gap;              ///< m, that it keeps, the face's sag included
  std::vector<CachedQuery> seen;       ///< that point when the obstacle was last asked, and how far above its gap
  std::vector<ColorRange> colors;

  Index count() const { return static_cast<Index>(slots.size()); }  ///< of faces
};

/// A lower bound of how far a whole surface is away from an obstacle.
struct Away {
  float distance = -std::numeric_limits<float>::infinity();  ///< m
  float largest_gap = 0;                                     ///< m, that any of its particles ever keeps
  FieldPlacement placement;                                  ///< where the obstacle was then
};

/// What is close enough to one obstacle to be tested in every iteration, found anew every few, and what is known about
/// every particle.
struct NearField {
  std::vector<Index> particles;
  NearEdges edges;
  NearFaces faces;
  std::vector<float> gap;            ///< m, per particle: the gap now; idle ones, too
  std::vector<float> clearance;      ///< m, per particle: least that its distance is above its gap; idle: infinite
  std::vector<CachedQuery> last;     ///< per particle: where it last was on the right side; empty: nothing is known yet
  std::vector<CachedQuery> middles;  ///< each when the obstacle was last asked, and how far above its gap
  Away away;                         ///< when all particles were last seen, less what they moved since
};

}  // namespace gracilis
