#include "gates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis::contact_check {

const std::vector<std::string>& measure_names() {
  static const std::vector<std::string> names = {"face pairs beyond rest",         "self pairs beyond rest",
                                                 "share of vertices 0.2 mm deep",  "depth beyond rest, mm",
                                                 "growth of overlap at rest, mm",  "bone edges beyond rest",
                                                 "share of dihedrals over 90 deg", "volume error"};
  return names;
}

Verdict hold_against(const Gates& gates, const Judge& judge, const FrameVerdict& frame) {
  Verdict worst(measure_names().size());
  for (Worst& w : worst) w.frame = frame.number;
  if (!frame.finite) {
    for (Worst& w : worst) w.value = std::numeric_limits<Real>::infinity(), w.where = "not finite", w.missed = true;
    return worst;
  }
  const auto name = [&](Index muscle) { return judge.muscles()[static_cast<std::size_t>(muscle)].name; };
  const auto keep = [&](std::size_t measure, Real value, const std::string& where) {
    if (value > worst[measure].value) worst[measure].value = value, worst[measure].where = where;
  };
  Index deep_vertices = 0, folded_dihedrals = 0;
  std::string deep_where, folded_where;
  Index deep_most = 0, folded_most = 0;
  for (const PairVerdict& pair : frame.pairs) {
    const std::string where = name(pair.first) + " + " + name(pair.second);
    keep(face_pairs, pair.excess(), where);
    keep(depth, 1000 * pair.depth_beyond_rest, where);
    if (pair.depth_rest > 0) keep(growth, 1000 * (pair.depth - pair.depth_rest), where);
    deep_vertices += pair.deep_vertices;
    if (pair.deep_vertices > deep_most) deep_most = pair.deep_vertices, deep_where = where;
  }
  for (std::size_t m = 0; m < frame.muscles.size(); ++m) {
    const MuscleVerdict& muscle = frame.muscles[m];
    const std::string where = name(static_cast<Index>(m));
    keep(self_pairs, muscle.self_excess(), where);
    keep(bone_edges, muscle.bone_edges, where + " + " + muscle.bone);
    keep(volume_error, std::abs(muscle.volume_ratio - 1), where);
    folded_dihedrals += muscle.folded_dihedrals;
    if (muscle.folded_dihedrals > folded_most) folded_most = muscle.folded_dihedrals, folded_where = where;
  }
  keep(deep_share, static_cast<Real>(deep_vertices) / judge.vertex_count(), deep_where);
  keep(folded_share, static_cast<Real>(folded_dihedrals) / judge.dihedral_count(), folded_where);
  worst[face_pairs].missed = worst[face_pairs].value > gates.face_pairs;
  worst[self_pairs].missed = worst[self_pairs].value > gates.self_pairs;
  worst[deep_share].missed = worst[deep_share].value >= gates.deep_share && deep_vertices > 0;
  worst[depth].missed = worst[depth].value > 1000 * gates.depth;
  worst[growth].missed = worst[growth].value > 1000 * gates.growth;
  worst[bone_edges].missed = worst[bone_edges].value > gates.bone_edges;
  worst[folded_share].missed = worst[folded_share].value >= gates.folded_share && folded_dihedrals > 0;
  worst[volume_error].missed = worst[volume_error].value > gates.volume;
  return worst;
}

void keep_worst(const Verdict& frame, Verdict& run) {
  if (run.empty()) {
    run = frame;
    return;
  }
  for (std::size_t i = 0; i < run.size(); ++i) {
    const bool missed = run[i].missed || frame[i].missed;
    if (frame[i].value > run[i].value) run[i] = frame[i];
    run[i].missed = missed;
  }
}

}  // namespace gracilis::contact_check
