#pragma once

#include <gracilis/dynamics/contact/mesh/patch_tree.hpp>
#include <gracilis/dynamics/movers.hpp>

#include <limits>
#include <vector>

namespace gracilis {

/// How surfaces meet.
struct SurfaceContactSettings {
  float friction = 0;     ///< largest tangential motion taken back, as a share of the push
  float cohesion = 0;     ///< m, farthest that particles which touch at rest may part; 0: as they like
  int update_period = 5;  ///< frames after which everything is searched anew
  /// m, that contacts take a particle away from where a step began
  float most_motion = std::numeric_limits<float>::infinity();
};

/// Two surfaces that must not pass through each other, or one with itself. A particle keeps its gap to the other
/// surface: the margin, or what there was at rest where that is less. Particles that lie in the other at rest come to
/// their gap gradually (overlap_release.hpp).
struct SurfacePair {
  Index first = 0, second = 0;                      ///< equal: self-contact
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();  ///< from the first's coordinates to the second's, m
  float reach = 0.006f;                      ///< m, farthest that one is looked for from the other, once per step
  std::vector<float> first_gap, second_gap;  ///< m, per particle
  std::vector<char> first_overlaps, second_overlaps;  ///< which particles lie in the other at rest; empty: none
  Eigen::Matrix3Xf first_ways, second_ways;  ///< unit, where those are to come out, in the other's shape at rest; zero:
                                             ///< where it is nearest; empty: none
  std::vector<float> first_deepest, second_deepest;  ///< m, how deep the two lie in each other at rest around each
                                                     ///< particle, of those that can move; empty: not at all
  float release = 0;  ///< m per step, how fast those come out that do: all alike, so that nothing bends on its way
  std::vector<char> first_touches, second_touches;  ///< which particles touch the other at rest; for cohesion
  bool is_self() const { return first == second; }  ///< a surface with itself
};

/// Whether a particle lies in the other surface at rest, by the pair's `first_overlaps` or `second_overlaps`.
inline bool overlaps_at_rest(const std::vector<char>& overlaps, Index particle) {
  return !overlaps.empty() && overlaps[static_cast<std::size_t>(particle)];
}

/// How deep a particle may lie in the other surface, by the pair's `first_deepest` or `second_deepest`, m.
inline float depth_at_rest(const std::vector<float>& deepest, Index particle) {
  return deepest.empty() ? 0 : deepest[static_cast<std::size_t>(particle)];
}

/// All surfaces that keep out of each other, and their pairs; constant. Self-contact needs the shape at rest, to tell
/// what belongs together: `rest` and its normals per surface.
struct ContactWorld {
  std::vector<ContactSurface> surfaces;
  std::vector<Eigen::Matrix3Xf> rest, rest_normals;
  std::vector<float> neighborhood;  ///< m, per surface: parts nearer than this at rest do not meet each other
  std::vector<SurfacePair> pairs;
  std::vector<std::vector<Index>> rounds;  ///< pairs without a surface in common, which may be projected together
  SurfaceContactSettings settings;
};

/// A particle of one surface near a face of the other. `side` is -1 where a sheet meets its own back from inside.
struct VertexFaceCandidate {
  Index particle = 0, face = 0;
  float side = 1;
  float distance = 0;                                       ///< m, on that side, when last looked at
  Eigen::Vector3f barycentric = Eigen::Vector3f::Zero();    ///< of the nearest point then
  Eigen::Vector3f offset = Eigen::Vector3f::Zero();         ///< m, from the nearest point to the particle then
  float most_gap = std::numeric_limits<float>::infinity();  ///< m, the pair's gap, or less: what neighbors leave each
                                                            ///< other, or may be asked for in this step
};
/// Two edges that cross closely, one of each surface; `side` as above.
struct EdgeEdgeCandidate {
  Index first = 0, second = 0;
  float side = 1;
  float most_gap = std::numeric_limits<float>::infinity();  ///< as above; of the gaps at the ends the largest
  Eigen::Vector3f outward = Eigen::Vector3f::Zero();  ///< from the second when last looked at, as edge_gap wants it
};

/// What is near what; workspace.
struct PairCandidates {
  std::vector<VertexFaceCandidate> near_second, near_first;  ///< found by a search, walked since: particles of the
                                                             ///< first near the second and the other way; of a surface
                                                             ///< with itself all in the first of the two
  std::vector<VertexFaceCandidate> on_second, on_first;      ///< of these, what every iteration projects
  std::vector<EdgeEdgeCandidate> edges;
  bool is_new = true;                                    ///< not looked at in this step
  bool is_calm = false;                                  ///< so little moved that the last look's lists stay
  float drift = std::numeric_limits<float>::infinity();  ///< m, at most, from the search to the last look: of what is
                                                         ///< near against what it is near to
  int steps = 0;                                         ///< since the search
  bool none_listed() const { return on_second.empty() && on_first.empty() && edges.empty(); }  ///< no candidates
};
struct ContactWorldState {
  std::vector<Particles> before;        ///< per surface, where its particles were before the step
  std::vector<std::vector<char>> torn;  ///< per surface, which particles contact lets go of in this step
  std::vector<PatchTree> trees;
  std::vector<Eigen::Matrix3Xf> normals;   ///< of particles; up to date where the next iterations ask
  std::vector<PairCandidates> candidates;  ///< one per pair
  int frames = 0;                          ///< begun so far; every update_period-th searches anew
};

/// Whether one of the pair's surfaces is among the movers.
inline bool any_moves(const SurfacePair& pair, const Movers& movers) {
  return movers.move(static_cast<std::size_t>(pair.first)) || movers.move(static_cast<std::size_t>(pair.second));
}

/// Groups the pairs into rounds. Call it once all pairs are there.
void arrange_rounds(ContactWorld& world);

/// A state for surfaces at rest.
ContactWorldState make_contact_state(const ContactWorld& world);

/// Before a step moves anything: where everything is.
void remember_places(const std::vector<const Particles*>& particles, ContactWorldState& state);

/// At the beginning of a frame: every update_period-th forgets what was found, so that its first update_broad_phase
/// searches everything.
void begin_contact_frame(const ContactWorld& world, ContactWorldState& state);

/// Makes the next update_broad_phase search everything, and counts frames from here.
void forget_candidates(ContactWorldState& state);

}  // namespace gracilis
