#pragma once

#include <gracilis/dynamics/constraints/constraint_sets.hpp>
#include <gracilis/dynamics/particles.hpp>
#include <gracilis/geometry/field_path.hpp>

#include <array>
#include <limits>
#include <vector>

namespace gracilis {

/// What is done about particles so fast that they would pass through an obstacle.
enum class MotionGuard {
  none,
  turned_direction,  ///< goes back where the direction to the surface turned by more than 135 degrees (published)
  kept_path          ///< follows its path in the obstacle's frame and slides where the obstacle stands in the way
};

/// The gaps that points of a surface must keep from an obstacle, m. The gap in an edge or a face is that between its
/// corners' gaps, plus its sag. Gaps may be negative where the data overlap at rest.
struct ContactGaps {
  std::vector<float> particle;  ///< one per particle
  std::vector<float> edge_sag;  ///< at most 0, one per distance slot; empty: edges are not tested
  std::vector<float> face_sag;  ///< the same per face slot
};

/// Faces so large that something can poke through between their edges.
struct FaceSet {
  std::array<std::vector<Index>, 3> particles;
  std::vector<ColorRange> colors;  ///< faces of one color share no particle

  Index count() const { return static_cast<Index>(particles[0].size()); }
};

FaceSet build_face_set(const Eigen::Matrix3Xi& faces, Index particle_count);

/// The middle of an edge that keeps a gap of its own, m, whatever its ends keep.
struct EdgeMiddle {
  Index a, b;  ///< particles, one at least can move
  float gap;
};

/// Keeps particles, edges (those of the distance constraints) and large faces out of a rigid obstacle: C = d(x) - gap
/// >= 0, without compliance.
struct FieldContactSet {
  BoundedField field;          ///< in the obstacle's frame
  ContactGaps captured;        ///< in the capture pose
  ContactGaps released;        ///< once the obstacle has moved against the surface
  std::vector<float> ceiling;  ///< m, one per particle: the largest distance it may have; empty: none
  std::vector<EdgeMiddle> middles;
  MotionGuard guard = MotionGuard::kept_path;
};

/// Carries the particles' frame into the obstacle's: q = rotation x + translation.
struct FieldPlacement {
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  Eigen::Vector3f translation = Eigen::Vector3f::Zero();
  float release = 0;  ///< from the captured gaps (0) to the released ones (1)

  Eigen::Vector3f to_obstacle(const Eigen::Vector3f& x) const { return rotation * x + translation; }
  Eigen::Vector3f from_obstacle(const Eigen::Vector3f& q) const { return rotation.transpose() * (q - translation); }
};

/// A particle in the obstacle's frame, and a lower bound of the distance there.
struct Sighting {
  Eigen::Vector3f place = Eigen::Vector3f::Zero();
  float distance = 0;
};

/// A field's slope may exceed 1 by rounding and interpolation.
inline constexpr float steepest = 1.1f;

/// Whether what was `seen` may have come down to `level` on its way to `q`.
inline bool may_reach(const Sighting& seen, const Eigen::Vector3f& q, float level) {
  const float left = seen.distance - level;
  return left <= 0 || steepest * steepest * (q - seen.place).squaredNorm() >= left * left;
}

/// The share of an edge or a face at an end or a corner that cannot move which is not tested: nothing can be pushed out
/// there without throwing the other end far away.
inline constexpr float untested_share = 0.2f;

/// Edges near an obstacle, one per slot. Every color is padded to whole groups with edges between copies of the idle
/// particle.
struct NearEdges {
  AlignedVector<Index> a, b;                    ///< particles
  AlignedVector<float> gap_a, gap_b;            ///< m, that the ends keep, the edge's sag included
  AlignedVector<float> t;                       ///< the deepest point, 0 at a, 1 at b; or unknown_point
  AlignedVector<float> seen_x, seen_y, seen_z;  ///< where it was when the obstacle was last asked, m,
  AlignedVector<float> seen_above;              ///< and how far above its gap at least, m
  std::vector<ColorRange> colors;

  Index count() const { return static_cast<Index>(a.size()); }
};
inline constexpr float unknown_point = -1;  ///< nobody has looked yet; what was seen is that of the middle

/// Large faces near an obstacle.
struct NearFaces {
  std::vector<Index> slots;            ///< in the face set, grouped by color
  std::vector<Eigen::Vector3f> where;  ///< the deepest point, barycentric
  std::vector<float> gap;              ///< m, that it keeps, the face's sag included
  std::vector<Sighting> seen;          ///< that point when the obstacle was last asked, and how far above its gap
  std::vector<ColorRange> colors;

  Index count() const { return static_cast<Index>(slots.size()); }
};

/// Gradients shorter than this, squared, tell no way out: on a field's ridges they fade.
inline constexpr float least_slope2 = 1e-4f;

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
  std::vector<float> gap;        ///< m, per particle: the gap now; one more for the idle particle
  std::vector<float> clearance;  ///< m, per particle: least that its distance is above its gap; idle: infinite
  std::vector<Sighting> last;    ///< per particle: where it last was on the right side; empty: nothing is known yet
  std::vector<Sighting> middles;  ///< each when the obstacle was last asked, and how far above its gap
  Away away;                      ///< when all particles were last seen, less what they moved since
};

/// Empties the lists of what is near.
void clear_near(NearField& near);

/// Within what distance from its gap, m, a particle may be listed, or an edge or a face at it; faces are not much
/// larger than edges.
float listing_reach(const DistanceSet& distances, float reach);

/// What is known to be farther away than this need not be seen before every step, m.
inline constexpr float far_away = 0.02f;

/// Where the particles are before obstacles and particles move: that side of the surface is theirs.
void remember_sides(const FieldContactSet& set, const FieldPlacement& placement, const Particles& particles,
                    NearField& near);

/// Edges and faces count as near when they may come this deep below their gap before the next listing, m; no particle
/// may go farther than `listed_motion` until then.
inline constexpr float element_reach = 0.002f;
inline constexpr float listed_motion = element_reach / steepest;

/// Brings back particles that passed through the obstacle since they were last seen (the set's guard), then lists what
/// is within `reach` (m) of touching: movable particles, edges and faces with a movable corner.
void find_near(const FieldContactSet& set, const DistanceSet& distances, const FaceSet& faces,
               const FieldPlacement& placement, float reach, Particles& particles, NearField& near);

/// Finds the deepest points of the edges that are near anew: others may have become deeper than those that are
/// followed.
void find_edge_points(const FieldContactSet& set, const FieldPlacement& placement, const Particles& particles,
                      NearField& near);

/// Pushes the deepest points of edges, the middles that keep a gap of their own, the deepest points of faces, and
/// particles out along the field's gradient. Returns how many were touching. An edge's deepest point is followed from
/// iteration to iteration, a face's is that of the last listing.
Index project_edge_contacts(const FieldContactSet& set, const FieldPlacement& placement, NearField& near,
                            Particles& particles);
Index project_middle_contacts(const FieldContactSet& set, const FieldPlacement& placement, NearField& near,
                              Particles& particles);
Index project_face_contacts(const FieldContactSet& set, const FaceSet& faces, const FieldPlacement& placement,
                            NearField& near, Particles& particles);
Index project_particle_contacts(const FieldContactSet& set, const FieldPlacement& placement, NearField& near,
                                Particles& particles);

/// Particles near two obstacles or more move to where both gaps are kept: along the direction in which both distances
/// grow, out of the gap between them; between parallel surfaces, to the middle. Call after the particles' contacts.
/// Returns how many moved.
Index project_squeezed(const std::vector<FieldContactSet>& sets, const std::vector<FieldPlacement>& placements,
                       const std::vector<NearField>& near, Particles& particles);

}  // namespace gracilis
