#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace gracilis::contact_check {

static std::string place(const Vec3& point) {
  return fmt::format("({:.0f} {:.0f} {:.0f}) mm", 1000 * point.x(), 1000 * point.y(), 1000 * point.z());
}

static std::string names(const Judge& judge, const PairVerdict& pair) {
  return judge.muscles()[static_cast<std::size_t>(pair.first)].name + " + " +
         judge.muscles()[static_cast<std::size_t>(pair.second)].name;
}

static void print_pair(const Judge& judge, const PairVerdict& pair) {
  if (pair.face_pairs == 0 && pair.depth == 0) return;
  fmt::print(
      "        {}: {} pairs (rest {}) at {}, depth {:.2f} mm (rest {:.2f}), beyond rest {:.2f} mm at {}, {} vertices "
      "deep\n",
      names(judge, pair), pair.face_pairs, pair.face_pairs_rest, place(pair.faces_at), 1000 * pair.depth,
      1000 * pair.depth_rest, 1000 * pair.depth_beyond_rest, place(pair.deepest_at), pair.deep_vertices);
}

static void print_muscle(const JudgedMuscle& judged, const MuscleVerdict& muscle) {
  if (muscle.self_pairs != 0)
    fmt::print("        {}: {} self pairs (rest {}) at {}\n", judged.name, muscle.self_pairs, muscle.self_pairs_rest,
               place(muscle.self_at));
  if (muscle.bone_edges != 0)
    fmt::print(
        "        {}: {} edges newly cross a bone ({} of them away from attachments; crossing in all {}, rest {}), most "
        "{}, at {}\n",
        judged.name, muscle.bone_edges, muscle.bone_edges_unattached, muscle.bone_edges_all, muscle.bone_edges_all_rest,
        muscle.bone, place(muscle.bone_at));
  if (muscle.folded_dihedrals != 0)
    fmt::print("        {}: {} dihedrals over 90 deg at {}\n", judged.name, muscle.folded_dihedrals,
               place(muscle.folded_at));
}

void print_rest(const Judge& judge) {
  std::vector<Points> muscles, bones;
  for (const JudgedMuscle& muscle : judge.muscles()) muscles.push_back(muscle.rest.vertices);
  for (const JudgedBone& bone : judge.bones()) bones.push_back(bone.rest.vertices);
  const FrameVerdict rest = judge.judge(0, muscles, bones);
  Index faces = 0;
  for (const JudgedMuscle& muscle : judge.muscles()) faces += muscle.rest.face_count();
  fmt::print("{} muscles, {} vertices, {} faces, {} dihedrals; {} bones. At rest:\n", judge.muscles().size(),
             judge.vertex_count(), faces, judge.dihedral_count(), judge.bones().size());
  for (const PairVerdict& pair : rest.pairs) print_pair(judge, pair);
  for (std::size_t m = 0; m < rest.muscles.size(); ++m) {
    const JudgedMuscle& judged = judge.muscles()[m];
    print_muscle(judged, rest.muscles[m]);
    fmt::print("        {}: {} edges with a free end cross bones at rest; {} of {} vertices attached\n", judged.name,
               rest.muscles[m].bone_edges_all, std::count(judged.attached.begin(), judged.attached.end(), 1),
               judged.rest.vertex_count());
  }
}

void print_header() {
  fmt::print("{:>5}  {:>9}{:>9}{:>10}{:>10}{:>10}{:>9}{:>10}{:>10}\n", "frame", "pairs", "self", "deep %", "depth mm",
             "growth mm", "edges", "folded %", "volume %");
}

void print_frame(const Judge& judge, const FrameVerdict& frame, const Verdict& held, bool detail) {
  const auto cell = [&](std::size_t measure, int width, int digits, Real scale) {
    return fmt::format("{:>{}.{}f}{}", scale * held[measure].value, width - 1, digits,
                       held[measure].missed ? "*" : " ");
  };
  fmt::print("{:>5}  {}{}{}{}{}{}{}{}\n", frame.number, cell(face_pairs, 9, 0, 1), cell(self_pairs, 9, 0, 1),
             cell(deep_share, 10, 3, 100), cell(depth, 10, 2, 1), cell(growth, 10, 2, 1), cell(bone_edges, 9, 0, 1),
             cell(folded_share, 10, 3, 100), cell(volume_error, 10, 2, 100));
  if (detail) {
    for (const PairVerdict& pair : frame.pairs) print_pair(judge, pair);
    for (std::size_t m = 0; m < frame.muscles.size(); ++m) print_muscle(judge.muscles()[m], frame.muscles[m]);
  }
  std::fflush(stdout);
}

bool print_summary(const Verdict& worst) {
  fmt::print("\nworst of each measure\n");
  bool all = true;
  for (std::size_t i = 0; i < worst.size(); ++i) {
    fmt::print("{:<5} {:<32}{:>12.4g}   frame {:<5} {}\n", worst[i].missed ? "MISS" : "ok", measure_names()[i],
               worst[i].value, worst[i].frame, worst[i].value > 0 ? worst[i].where : "");
    all = all && !worst[i].missed;
  }
  return all;
}

}  // namespace gracilis::contact_check
