#include "gates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis::contact_check {

const std::vector<std::string>& measure_names() {
  static const std::vector<std::string> names = {"face pairs beyond rest",        "self pairs beyond rest",
                                                 "share of vertices 0.2 mm deep", "depth beyond rest, mm",
                                                 "growth of overlap at rest, mm", "bone edges beyond rest",
                                                 "share of hinges over 90 deg",   "volume error"};
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
  Index deep_vertices = 0, folded_hinges = 0;
  std::string deep_where, folded_where;
  Index deep_most = 0, folded_most = 0;
  for (const PairVerdict& pair : frame.pairs) {
    const std::string where = name(pair.first) + " + " + name(pair.second);
    keep(0, pair.excess(), where);
    keep(3, 1000 * pair.depth_beyond_rest, where);
    if (pair.depth_rest > 0) keep(4, 1000 * (pair.depth - pair.depth_rest), where);
    deep_vertices += pair.deep_vertices;
    if (pair.deep_vertices > deep_most) deep_most = pair.deep_vertices, deep_where = where;
  }
  for (std::size_t m = 0; m < frame.muscles.size(); ++m) {
    const MuscleVerdict& muscle = frame.muscles[m];
    const std::string where = name(static_cast<Index>(m));
    keep(1, muscle.self_excess(), where);
    keep(5, muscle.bone_edges, where + " + " + muscle.bone);
    keep(7, std::abs(muscle.volume_ratio - 1), where);
    folded_hinges += muscle.folded_hinges;
    if (muscle.folded_hinges > folded_most) folded_most = muscle.folded_hinges, folded_where = where;
  }
  keep(2, static_cast<Real>(deep_vertices) / judge.vertex_count(), deep_where);
  keep(6, static_cast<Real>(folded_hinges) / judge.hinge_count(), folded_where);
  worst[0].missed = worst[0].value > gates.face_pairs;
  worst[1].missed = worst[1].value > gates.self_pairs;
  worst[2].missed = worst[2].value >= gates.deep_share && deep_vertices > 0;
  worst[3].missed = worst[3].value > 1000 * gates.depth;
  worst[4].missed = worst[4].value > 1000 * gates.growth;
  worst[5].missed = worst[5].value > gates.bone_edges;
  worst[6].missed = worst[6].value >= gates.folded_share && folded_hinges > 0;
  worst[7].missed = worst[7].value > gates.volume;
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
