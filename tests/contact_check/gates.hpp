#pragma once

#include "judge.hpp"

#include <string>
#include <vector>

namespace gracilis::contact_check {

/// What a frame may show at most.
struct Gates {
  Index face_pairs = 0;       ///< beyond rest, per pair of muscles
  Index self_pairs = 0;       ///< beyond rest, per muscle
  Real deep_share = 0.001;    ///< of all muscles' vertices deeper than 0.2 mm in another muscle beyond rest (below)
  Real depth = 1e-3;          ///< m beyond rest
  Real growth = 1e-6;         ///< m, depth of a pair of muscles beyond that pair's depth at rest, if they overlap there
  Index bone_edges = 0;       ///< with a free end, that did not cross at rest
  Real folded_share = 0.001;  ///< of all dihedrals (below); 0: none at all
  Real volume = 0.005;        ///< |volume ratio - 1|
};

/// What is measured in every frame. Lengths in mm.
enum Measure { face_pairs, self_pairs, deep_share, depth, growth, bone_edges, folded_share, volume_error };

/// The worst value of one measure in a frame, or in a run.
struct Worst {
  Real value = 0;
  int frame = 0;
  std::string where;  ///< which muscles
  bool missed = false;
};

/// One entry for each Measure.
using Verdict = std::vector<Worst>;

/// By Measure.
const std::vector<std::string>& measure_names();

/// A frame held against the gates. A frame that is not finite misses all.
Verdict hold_against(const Gates& gates, const Judge& judge, const FrameVerdict& frame);

/// Keeps what is worse of each measure.
void keep_worst(const Verdict& frame, Verdict& run);

}  // namespace gracilis::contact_check
