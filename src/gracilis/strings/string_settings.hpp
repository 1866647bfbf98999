#pragma once

#include <gracilis/core/types.hpp>

#include <limits>

namespace gracilis::strings {

/// What holds a taut string in its place. All strings have the tension 1, so stiffnesses are ratios to it; per length
/// of the string, so that they do not depend on how many nodes it has. The same for every muscle and body.
struct StringSettings {
  int count = 48;     ///< strings of a muscle
  int segments = 20;  ///< of a string

  Real support_length = 0.007;   ///< m, s: what a fiber rested on holds it with 1/s² per length
  Real support_reach = 0.08;     ///< m: it slides over a bone the less the farther that is, and not at all beyond
  Real tie_length = 0.025;       ///< m, s: fascia ties it across its direction with 1/s² per length at a bone ...
  Real tie_reach = 0.03;         ///< m ... and with nothing this far from bones
  Real bone_gap = 0.004;         ///< m, kept to a bone where the gap at rest allows
  Real bone_stiffness = 30;      ///< of bones, over that of a segment
  Real neighbor_length = 0.015;  ///< m, s: neighbors hold their places across each other with 1/s² per length
  int neighbors = 10;            ///< of each string

  Real share_offset = 0.003;  ///< m, d: a body at the distance x carries a node with the share 1/(x + d)³
  Real pinned_reach = 0.02;   ///< m from its bone, within which the part of a fiber that turns back goes with the bone
  Real pinned_least = 0.003;  ///< m that such a part runs away from the fiber's other end

  int rest_iterations = 300;    ///< at most, until strings are taut in the capture pose ...
  Real rest_stop_move = 1e-9;   ///< m ... where none of their nodes moves further: that pose must be at rest
  int iterations = 8;           ///< in each step
  bool sections_first = true;   ///< whole cross-sections move before single strings do
  Real step_turn = radians(3);  ///< rad; bones never turn further against each other in one step
  Real longest_move = 0.004;    ///< m, of a node in one iteration
  Real stop_move = 2e-5;        ///< m; a string rests for the rest of a step once none of its nodes moves further
};

/// How strings come to rest. One of which no node moved further than `stop_move` (m) rests from then on; after
/// iteration `quenched_from` steps are small, which ends most going to and fro.
struct Relaxation {
  int iterations = 0;
  Real stop_move = 0;
  int quenched_from = std::numeric_limits<int>::max();
};

/// The share of its step that a string takes in an iteration: damped after some, for strings that go to and fro between
/// two bones.
inline Real taken_share(const Relaxation& relaxation, int iteration) {
  constexpr int undamped_iterations = 12;
  if (iteration > relaxation.quenched_from) return 0.25;
  return iteration > undamped_iterations ? 0.6 : 1;
}

}  // namespace gracilis::strings
