#include "bench_command.hpp"

#include "scene_options.hpp"

#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/anatomy/resolution/coarser_muscle.hpp>
#include <gracilis/anatomy/resolution/finer_muscle.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/core/state_hash.hpp>
#include <gracilis/dynamics/simd/instruction_set.hpp>
#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/io/scene/scene_changes.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/strings/bone_distances.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <utility>

namespace gracilis {

namespace {

using Clock = std::chrono::steady_clock;

struct BenchOptions {
  std::filesystem::path file;
  SceneOptions scene;
  std::vector<int> threads;
  int frame = -1;  ///< -1: a quarter of the motion
  int repeats = 15;
  int subdivide = 0;
  double coarsen = 0;  ///< m
  int muscles = 0;     ///< 0: those of the scene
  bool json = false;
};

/// One line of the answer.
struct BenchEntry {
  std::string muscle, phase;
  int threads = 1;
  Index triangles = 0;
  double milliseconds = 0;
  std::uint64_t hash = 0;
  double bytes_per_triangle = 0;  ///< at its peak, while the muscle was prepared and solved; 0: not asked
};

/// The poses from the capture pose to the frame asked for.
std::vector<Pose> poses_until(const Scene& scene, int frame) {
  std::vector<Pose> poses = pose_sequence(scene);
  const int last = static_cast<int>(poses.size()) - 1;
  if (frame > last)
    throw ConfigurationError(
        {"", "--frame", fmt::format("the motion has frames 0 to {}", last), "ask for one of them"});
  poses.resize(static_cast<std::size_t>(frame < 0 ? (last + 3) / 4 : frame) + 1);
  return poses;
}

/// A line of Linux's account of this process, bytes; 0 where there is none.
double memory_account(const char* name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind(name, 0) == 0) return 1024.0 * std::strtod(line.c_str() + std::strlen(name), nullptr);
  return 0;
}

/// What a piece of work needs beyond what the process holds before it: its peak, bytes, but not what of the program
/// itself is read from files meanwhile. Nothing freed before hides it.
class MemoryGrowth {
 public:
  MemoryGrowth() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;  // the peak counts from here
    before_ = memory_account("VmRSS:") - memory_account("RssFile:");
  }
  double peak() const { return memory_account("VmHWM:") - memory_account("RssFile:") - before_; }

 private:
  double before_ = 0;
};

/// Of all bones of a scene, as its method asks for them.
struct BoneFields {
  std::vector<DistanceField> near, far;
};

BoneFields bone_fields(const Scene& scene) {
  const MethodEntry& method = method_of(scene);
  BoneFields fields{cached_bone_fields(scene), {}};
  if (method.has_far_fields && method.has_far_fields(scene))
    fields.far = cached_bone_fields(scene, strings::far_field_settings());
  return fields;
}

/// The iteration first, then its phases. Muscles are timed relaxed and alone.
void time_muscle(const Scene& scene, const Muscle& muscle, const BoneFields& fields, const std::vector<Pose>& poses,
                 const BenchOptions& options, std::vector<BenchEntry>& entries) {
  const MemoryGrowth growth;
  const std::unique_ptr<PhaseTimer> timer =
      method_of(scene).phase_timer(scene, muscle, fields.near, fields.far, poses);
  const std::vector<std::string_view> phases = timer->phases();
  const double grown = growth.peak() / timer->triangles();
  for (const int threads : options.threads) {
    const ThreadLimit limit(threads);
    for (std::size_t phase = 0; phase < phases.size(); ++phase) {
      const PhaseTime time = timer->time(phase, options.repeats);
      entries.push_back({muscle.name, std::string(phases[phase]), threads, timer->triangles(), time.milliseconds,
                         time.hash, phase > 0 ? 0 : grown});
    }
  }
}

BoneFieldSource cached_fields_of(const Scene& scene) {
  return [&scene](const DistanceFieldSettings& settings) { return cached_bone_fields(scene, settings); };
}

/// Whole frames with all contact: the mean over those of the second half of the way, because contact is looked for in
/// some of them only.
BenchEntry time_frames(const Scene& scene, const std::vector<Pose>& poses, int threads) {
  const ThreadLimit limit(threads);
  const auto method = make_method(scene, cached_fields_of(scene));
  double sum = 0;
  int count = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const auto started = std::chrono::steady_clock::now();
    method->advance(poses[i], poses[i].time - poses[i - 1].time);
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - started;
    if (2 * i >= poses.size() - 1) sum += elapsed.count(), ++count;
  }
  BenchEntry entry{"all", "frame", threads, 0, 0, hash_seed, 0};
  for (const Muscle& muscle : scene.muscles) entry.triangles += muscle.surface.face_count();
  if (count == 0) return entry;
  entry.milliseconds = sum / count;
  Frame end;
  method->write(end);
  for (const MuscleShape& shape : end.muscles) entry.hash = hash_of(shape.points, entry.hash);
  return entry;
}

void print_json(const Scene& scene, int frame, const std::vector<BenchEntry>& entries) {
  nlohmann::ordered_json answer = {{"version", GRACILIS_VERSION},
                                   {"scene", scene.name},
                                   {"frame", frame},
                                   {"instruction_set", instruction_set()},
                                   {"benchmarks", nlohmann::ordered_json::array()}};
  for (const BenchEntry& entry : entries) {
    nlohmann::ordered_json line = {{"muscle", entry.muscle},   {"phase", entry.phase},
                                   {"threads", entry.threads}, {"triangles", entry.triangles},
                                   {"ms", entry.milliseconds}, {"hash", fmt::format("{:016x}", entry.hash)}};
    if (entry.bytes_per_triangle > 0) line["peak_bytes_per_triangle"] = std::round(entry.bytes_per_triangle);
    answer["benchmarks"].push_back(line);
  }
  fmt::print("{}\n", answer.dump(2));
}

void print_table(const std::vector<BenchEntry>& entries) {
  fmt::print("{:24} {:14} {:>7} {:>9} {:>10}  {}\n", "muscle", "phase", "threads", "triangles", "ms", "hash");
  for (const BenchEntry& entry : entries)
    fmt::print("{:24} {:14} {:7} {:9} {:10.4f}  {:016x}\n", entry.muscle, entry.phase, entry.threads, entry.triangles,
               entry.milliseconds, entry.hash);
}

/// As many muscles as asked for, copies of the scene's in turn. Copies lie in each other, so none keeps out of another.
void copy_muscles(Scene& scene, int count) {
  const std::vector<Muscle> originals = scene.muscles;
  scene.muscles.clear();
  scene.method.contact["muscle"] = "none";
  for (int i = 0; i < count; ++i) {
    scene.muscles.push_back(originals[static_cast<std::size_t>(i) % originals.size()]);
    scene.muscles.back().name += fmt::format("_{}", i);
  }
}

/// From before the scene was read, which took `reading`, until the first frame is solved, with the fields as the cache
/// has them.
BenchEntry time_first_frame(const Scene& scene, const std::vector<Pose>& poses, Clock::duration reading) {
  const Clock::time_point started = Clock::now();
  const auto method = make_method(scene, cached_fields_of(scene));
  if (poses.size() > 1) method->advance(poses[1], poses[1].time - poses[0].time);
  const std::chrono::duration<double, std::milli> elapsed = reading + (Clock::now() - started);
  BenchEntry entry{"all", "first_frame", thread_count(), 0, elapsed.count(), hash_seed, 0};
  for (const Muscle& muscle : scene.muscles) entry.triangles += muscle.surface.face_count();
  Frame frame;
  method->write(frame);
  for (const MuscleShape& shape : frame.muscles) entry.hash = hash_of(shape.points, entry.hash);
  return entry;
}

int bench(Scene scene, BenchOptions options, Clock::time_point started) {
  if (options.muscles > 0) copy_muscles(scene, options.muscles);
  const bool iterates = method_of(scene).phase_timer, is_resized = options.subdivide > 0 || options.coarsen > 0;
  if (is_resized && !iterates)
    throw ConfigurationError({"", "--subdivide, --coarsen",
                              "the scene's method does not iterate over the muscles' triangles",
                              "choose another method, or leave these out"});
  for (Muscle& muscle : scene.muscles) {
    if (options.coarsen > 0) muscle = coarser_muscle(muscle, options.coarsen).muscle;
    for (int i = 0; i < options.subdivide; ++i) muscle = finer_muscle(muscle);
  }
  if (options.threads.empty()) {
    options.threads = {1};
    if (thread_count() > 1) options.threads.push_back(thread_count());
  }
  const std::vector<Pose> poses = poses_until(scene, options.frame);
  const Clock::duration reading = Clock::now() - started;
  const BoneFields fields = iterates ? bone_fields(scene) : BoneFields();
  std::vector<BenchEntry> entries;
  if (iterates && options.muscles == 0)
    for (const Muscle& muscle : scene.muscles) time_muscle(scene, muscle, fields, poses, options, entries);
  if (options.muscles > 0 || !is_resized) {
    for (const int threads : options.threads) entries.push_back(time_frames(scene, poses, threads));
    entries.push_back(time_first_frame(scene, poses, reading));
  }
  if (options.json)
    print_json(scene, static_cast<int>(poses.size()) - 1, entries);
  else
    print_table(entries);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_bench_command(CLI::App& program, Command& chosen) {
  CLI::App* command = program.add_subcommand("bench",
                                             "Time one iteration, its phases and whole frames of a scene, frames alone "
                                             "where the method does not iterate; of the built-in hip without one");
  const auto options = std::make_shared<BenchOptions>();
  add_scene_options(*command, options->file, options->scene);
  command->get_option("SCENE")->required(false);
  command->add_option("--threads", options->threads, "Numbers of threads, separated by commas (default: 1 and all)")
      ->delimiter(',')
      ->allow_extra_args(false)  // or it takes the scene that follows for one
      ->check(CLI::Range(1, 1024));
  command->add_option("--frame", options->frame, "Frame of the motion to time at (default: a quarter of the way)")
      ->check(CLI::Range(0, 1000000));
  command->add_option("--repeats", options->repeats, "How often each is timed; the median counts (default: 15)")
      ->check(CLI::Range(1, 100000));
  command
      ->add_option("--subdivide", options->subdivide,
                   "Divide every triangle of the muscles into four, so many times over, to see how the time of an "
                   "iteration grows; frames are timed only with --muscles")
      ->check(CLI::Range(0, 6));
  command
      ->add_option("--coarsen", options->coarsen,
                   "Before that, take copies of the muscles with edges of about this length, m, to see how it shrinks")
      ->check(CLI::Range(0.0, 1.0));
  command
      ->add_option("--muscles", options->muscles,
                   "Time frames of so many muscles, copies of the scene's in turn, to see how time grows")
      ->check(CLI::Range(1, 10000));
  command->add_flag("--json", options->json, "Print JSON instead of a table");
  command->callback([&chosen, options] {
    chosen = [options] {
      const Clock::time_point started = Clock::now();
      if (!options->file.empty()) return bench(read_scene(options->file, options->scene).scene, *options, started);
      LoadedScene hip;
      hip.scene = demo_scene("hip");
      change_scene(hip, options->scene.set, options->scene.only);
      return bench(hip.scene, *options, started);
    };
  });
}

}  // namespace gracilis
