#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/core/state_hash.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/simulate/measures.hpp>
#include <gracilis/simulate/run.hpp>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <ctime>

/// Runs a scene in several settings and tells how much processor time a frame takes (of all threads together) and how
/// far every muscle's last shape is from the first setting's: the same vertices, straight line.
namespace gracilis {
namespace {

struct Outcome {
  std::vector<Points> shapes;
  std::vector<MuscleMeasures> measures;
  std::vector<std::string> names;
  Index triangles = 0;  ///< simulated
  Real milliseconds = 0;
};

Outcome run(const std::filesystem::path& file, const SceneOptions& options, int frames) {
  const Scene scene = read_scene(file, options).scene;
  std::vector<Pose> poses = pose_sequence(scene);
  if (frames > 0) poses.resize(std::min(poses.size(), static_cast<std::size_t>(frames) + 1));
  const auto method =
      make_method(scene, [&](const DistanceFieldSettings& settings) { return cached_bone_fields(scene, settings); });
  Outcome outcome;
  std::vector<Real> times;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const std::clock_t started = std::clock();
    const StepReport report = method->advance(poses[i], poses[i].time - poses[i - 1].time);
    times.push_back(1000 * static_cast<Real>(std::clock() - started) / CLOCKS_PER_SEC);
    outcome.triangles = 0;
    for (const MuscleReport& muscle : report.muscles)
      outcome.triangles += static_cast<Index>(metric(muscle.metrics, "triangles"));
  }
  Frame frame;
  frame.pose = poses.back();
  method->write(frame);
  outcome.measures = Measurer(scene).measure(frame);
  for (const Muscle& muscle : scene.muscles) outcome.names.push_back(muscle.name);
  for (MuscleShape& shape : frame.muscles) outcome.shapes.push_back(std::move(shape.points));
  if (!times.empty()) {
    std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
    outcome.milliseconds = times[times.size() / 2];
  }
  return outcome;
}

void print(const std::string& variant, const Outcome& outcome, const Outcome& reference) {
  for (std::size_t m = 0; m < outcome.shapes.size(); ++m) {
    Eigen::VectorXd away = (outcome.shapes[m] - reference.shapes[m]).colwise().norm().transpose() * 1000;
    std::sort(away.begin(), away.end());
    const MuscleMeasures& measures = outcome.measures[m];
    fmt::print("{},{},{},{:.2f},{:.3f},{:.3f},{:.3f},{:.4f},{:.3f},{:.3f},{},{:.2f},{:016x}\n", variant,
               outcome.names[m], outcome.triangles, outcome.milliseconds, away.mean(),
               away[static_cast<Index>(0.99 * static_cast<Real>(away.size() - 1))], away[away.size() - 1],
               measures.volume_ratio, 1000 * measures.vertex_depth_beyond_rest,
               1000 * measures.midpoint_depth_beyond_rest, measures.dihedrals_over_90, measures.edge_ratio_max_free,
               hash_of(outcome.shapes[m]));
  }
  std::fflush(stdout);
}

int run_all(int count, char** arguments) {
  CLI::App program("How far the last shapes of several settings are from the first one's");
  std::filesystem::path file;
  SceneOptions common;
  std::vector<std::string> variants;
  int frames = 0, threads = 0;
  program.add_option("SCENE", file)->required();
  program.add_option("--set", common.set, "for all settings")->allow_extra_args(false);
  program.add_option("--only", common.only)->delimiter(',')->allow_extra_args(false);
  program.add_option("--frames", frames, "stop after so many");
  program.add_option("--threads", threads);
  program.add_option("VARIANT", variants, "KEY=VALUE;KEY=VALUE..., the first is the reference; '-' sets nothing")
      ->required();
  CLI11_PARSE(program, count, arguments);
  const ThreadLimit limit(threads);
  fmt::print(
      "setting,muscle,triangles,processor_ms_per_frame,mean_mm,p99_mm,max_mm,volume,vertex_depth_mm,midpoint_depth_mm,"
      "dihedrals_over_90,edge_ratio,hash\n");
  Outcome reference;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    SceneOptions options = common;
    if (variants[i] != "-")
      for (const std::string& set : CLI::detail::split(variants[i], ';')) options.set.push_back(set);
    Outcome outcome = run(file, options, frames);
    if (i == 0) reference = outcome;
    print(variants[i], outcome, reference);
  }
  return 0;
}

}  // namespace
}  // namespace gracilis

int main(int count, char** arguments) {
  try {
    return gracilis::run_all(count, arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
