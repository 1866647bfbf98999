#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/dynamics/particles.hpp>
#include <gracilis/geometry/topology.hpp>

#include <random>
#include <vector>

namespace gracilis {

/// Along which line the ends of an edge that is too short are pushed apart; see parting_direction().
enum class EdgeResolution { push, unit_sum, vector_sum };

/// What becomes of an edge that ended on the same two particles as another.
enum class CoincidingEdgeRule { keep, drop, reseed };

struct VirtualEdgeSettings {
  float reach = 0.02f;      ///< m, longest that an edge may be where it is seeded
  float distance = 0.002f;  ///< m, contact distance: what the ends of shorter edges are pushed apart to
  bool adaptive = false;    ///< raise it to what the ends came nearer in the step, at most to the reach
  int walk_steps = 100;     ///< of one walk at most
  int update_period = 5;    ///< frames between two seedings
  EdgeResolution resolution = EdgeResolution::vector_sum;
  bool reset = false;  ///< walks begin at the seeds in every iteration, not where the last ended
  CoincidingEdgeRule coinciding = CoincidingEdgeRule::keep;
};

/// A particle of one surface and one of another, which look for each other's neighborhood (Havlíček 2024, section
/// 5.2.1).
struct VirtualEdge {
  Index a = 0, b = 0;
  auto operator<=>(const VirtualEdge&) const = default;  ///< by a, then by b  NOLINT(modernize-use-nullptr)
};

/// Two surfaces that keep out of each other by virtual edges.
struct VirtualEdgePair {
  Index first = 0, second = 0;
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();  ///< from the first's coordinates to the second's, m
};

/// All surfaces that virtual edges keep apart, and their pairs; constant.
struct VirtualEdgeWorld {
  std::vector<VertexStars> stars;  ///< neighbors of the particles, per surface
  std::vector<VirtualEdgePair> pairs;
  std::vector<std::vector<Index>> rounds;  ///< pairs without a surface in common, which may be processed together
  VirtualEdgeSettings settings;
};

/// The edges of one pair.
struct PairEdges {
  struct Edge {
    VirtualEdge seed, now;
    float distance = 0;  ///< m, its contact distance in this step
  };
  std::vector<Edge> edges;  ///< processed in this order
  Index pushes = 0;         ///< in the last iteration
  Index coinciding = 0;     ///< at the end of the last frame, before anything was done about them
  std::minstd_rand random;
};

/// What changes. A copy is a checkpoint.
struct VirtualEdgeState {
  std::vector<PairEdges> pairs;
  std::vector<Particles> previous;  ///< per surface, before the step's prediction
  int frames = 0;                   ///< begun so far; every update_period-th seeds
};

/// Where a walk ended.
struct EdgeWalk {
  VirtualEdge end;
  int steps = 0;
  bool near = false;  ///< stopped because it is shorter than the contact distance
};

/// Zig-zag descent: first `a`, then `b` goes to that neighbor which makes the edge shortest, until neither finds one
/// (a local minimum), the edge is shorter than `distance` (m), or after `most_steps` such steps (Havlíček 2024, section
/// 5.2.1.2 and source code 6.5). Of equally near neighbors the one with the lowest number is taken. `shift` leads from
/// the first's coordinates to the second's.
EdgeWalk walk_virtual_edge(VirtualEdge edge, const VertexStars& first_stars, const Particles& first,
                           const VertexStars& second_stars, const Particles& second, const Eigen::Vector3f& shift,
                           float distance, int most_steps);

/// The direction from the second end to the first in which they are parted to `distance`; `now` and `before` (m) lead
/// from the second to the first, now and before the step. With n = now/|now|, and back = before - now the way back:
/// push: n. unit_sum: n + back/|back|. vector_sum: distance n + back (Havlíček 2024, Eqs. 5.2 and 5.3 about the ends'
/// midpoint; docs/mathematics.md). Unit length; n where the sum vanishes, zero where nothing tells a direction.
Eigen::Vector3f parting_direction(EdgeResolution resolution, const Eigen::Vector3f& now, const Eigen::Vector3f& before,
                                  float distance);

/// Moves the ends to `distance` from each other, each by its inverse mass, so that momentum is kept. False when both
/// are fixed, or nothing tells a direction.
bool part_ends(VirtualEdge edge, EdgeResolution resolution, float distance, const Eigen::Vector3f& shift,
               const Particles& first_before, const Particles& second_before, Particles& first, Particles& second);

/// At the beginning of a step, before the prediction: remembers where the particles are.
void remember_positions(const std::vector<const Particles*>& particles, VirtualEdgeState& state);

/// After the prediction: the contact distance of each edge in this step.
void adapt_distances(const VirtualEdgeWorld& world, const std::vector<const Particles*>& particles,
                     VirtualEdgeState& state);

/// One iteration: each edge in turn walks, and pushes its ends apart at once where it came too near. Returns how many
/// pushed.
Index project_virtual_edges(const VirtualEdgeWorld& world, const std::vector<Particles*>& particles,
                            VirtualEdgeState& state);

}  // namespace gracilis
