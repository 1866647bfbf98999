#include "gates.hpp"
#include "recorded_run.hpp"
#include "report.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>

/// Judges what `gracilis run` left behind, or surfaces as they are, and prints a table; 1 when a gate is missed.
namespace gracilis::contact_check {

struct Options {
  std::filesystem::path run;
  std::vector<std::filesystem::path> muscles, bones;
  Real unit = 1e-3;
  int every = 1;
  std::vector<int> frames;
  bool detail = false;
  Gates gates;
};

static std::vector<int> chosen_frames(const Options& options, int count) {
  std::vector<int> frames;
  for (const int frame : options.frames)
    if (frame >= 0 && frame < count) frames.push_back(frame);
  if (!options.frames.empty()) return frames;
  for (int frame = 0; frame < count; frame += options.every) frames.push_back(frame);
  if (count > 0 && frames.back() != count - 1) frames.push_back(count - 1);
  return frames;
}

static int judge_run(const Options& options) {
  const RecordedRun run = open_run(options.run);
  const std::vector<int> frames = chosen_frames(options, run.frame_count);
  if (frames.empty()) {
    std::cerr << "error: none of these frames is there\n";
    return 2;
  }
  const Judge judge = judge_of(run);
  print_rest(judge);
  print_header();
  Verdict worst;
  for (const int frame : frames) {
    const FrameVerdict verdict =
        judge.judge(frame, read_points(run, run.muscles, frame), read_points(run, run.bones, frame));
    const Verdict held = hold_against(options.gates, judge, verdict);
    print_frame(judge, verdict, held, options.detail);
    keep_worst(held, worst);
  }
  return print_summary(worst) ? 0 : 1;
}

/// Surfaces as they are: all that cuts is counted, nothing is forgiven for being at rest.
static int judge_surfaces(const Options& options) {
  std::vector<JudgedMuscle> muscles;
  std::vector<JudgedBone> bones;
  for (const auto& file : options.muscles) {
    const TriangleMesh mesh = read_mesh(file, options.unit);
    muscles.push_back(
        {file.stem().string(), mesh, std::vector<char>(static_cast<std::size_t>(mesh.vertex_count()), 0)});
  }
  for (const auto& file : options.bones) bones.push_back({file.stem().string(), read_mesh(file, options.unit)});
  print_rest(Judge(std::move(muscles), std::move(bones)));
  return 0;
}

static int check(int argc, char** argv) {
  CLI::App program("Do muscles cut each other, themselves or bones?");
  Options options;
  program.add_option("RUN", options.run, "A folder that `gracilis run` or `gracilis demo` wrote");
  program.add_option("--muscle", options.muscles, "Surfaces instead of a run: what overlaps in them as they are");
  program.add_option("--bone", options.bones, "Bones to go with --muscle");
  program.add_option("--unit", options.unit, "Length of the unit of --muscle and --bone files, m")
      ->capture_default_str();
  program.add_option("--every", options.every, "Judge every so many frames, and the last")->check(CLI::PositiveNumber);
  program.add_option("--frames", options.frames, "Judge these frames only")->delimiter(',');
  program.add_flag("--detail", options.detail, "Say of every frame which muscles, and where in the capture pose");
  program.add_option("--max-pairs", options.gates.face_pairs, "Intersecting faces per two muscles, beyond rest");
  program.add_option("--max-self", options.gates.self_pairs, "Intersecting faces within one muscle, beyond rest");
  program.add_option("--max-deep-share", options.gates.deep_share, "Share of vertices 0.2 mm deep in another muscle");
  Real depth = 1000 * options.gates.depth, growth = 1000 * options.gates.growth;
  program.add_option("--max-depth-mm", depth, "Deepest vertex in another muscle, beyond rest");
  program.add_option("--max-growth-mm", growth, "Growth of the depth of two muscles that overlap at rest");
  program.add_option("--max-bone-edges", options.gates.bone_edges, "Edges that cross a bone, beyond rest");
  program.add_option("--max-folded-share", options.gates.folded_share,
                     "Share of dihedrals turned over 90 degrees; 0: none");
  program.add_option("--max-volume", options.gates.volume, "|volume ratio - 1|");
  CLI11_PARSE(program, argc, argv);
  options.gates.depth = depth / 1000, options.gates.growth = growth / 1000;
  if (options.run.empty() == options.muscles.empty()) {
    std::cerr << "error: give either a run folder or --muscle files\n";
    return 2;
  }
  return options.run.empty() ? judge_surfaces(options) : judge_run(options);
}

}  // namespace gracilis::contact_check

int main(int argc, char** argv) {
  try {
    return gracilis::contact_check::check(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 3;
  }
}
