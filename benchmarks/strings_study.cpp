#include <gracilis/anatomy/joints/joint_twists.hpp>
#include <gracilis/anatomy/overlap/bone_field.hpp>
#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/core/median.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/methods/method_entry.hpp>
#include <gracilis/methods/strings/settings.hpp>
#include <gracilis/strings/lane_relaxation.hpp>
#include <gracilis/strings/node_relaxation.hpp>
#include <gracilis/strings/relaxation.hpp>
#include <gracilis/strings/string_arms.hpp>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>

/// What strings cost and how near to rest they come, muscle by muscle on one thread: a scene's poses, its frames. The
/// reference follows the same poses in double precision with many iterations.
namespace gracilis::strings {
namespace {

constexpr int reference_iterations = 600;
constexpr Real reference_stop_move = 1e-7;

struct Outcome {
  Real microseconds = 0, arms_microseconds = 0, reference_microseconds = 0;             ///< medians over poses
  Real node_error = 0, worst_pose_error = 0, length_error = 0, worst_length_error = 0;  ///< m
};

template <class Act>
Real microseconds_of(const Act& act) {
  const auto started = std::chrono::steady_clock::now();
  act();
  return std::chrono::duration<Real, std::micro>(std::chrono::steady_clock::now() - started).count();
}

Real mean_length(const MuscleStrings& muscle, const Points& places) {
  Real sum = 0;
  for (Index s = 0; s < muscle.strings; ++s)
    for (Index i = 0; i + 1 < muscle.nodes; ++i)
      sum += (places.col(muscle.node(s, i + 1)) - places.col(muscle.node(s, i))).norm();
  return sum / static_cast<Real>(muscle.strings);
}

/// A pose and how bodies move from there with each coordinate.
struct StudyPose {
  Pose pose;
  std::vector<std::vector<Twist>> twists;
};

Outcome study(const MuscleStrings& muscle, const BoneDistances& bones, const std::vector<StudyPose>& poses,
              int repeats) {
  Outcome outcome;
  std::vector<std::vector<Real>> times(poses.size());
  std::vector<Real> arms_times, reference_times;
  const std::size_t bodies = poses.front().pose.bodies.size();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    StringState state = capture_state(muscle, bodies), reference = state;
    for (std::size_t p = 0; p < poses.size(); ++p) {
      times[p].push_back(microseconds_of([&] { follow(muscle, bones, poses[p].pose, state); }));
      if (repeat > 0) continue;
      arms_times.push_back(microseconds_of([&] { string_actions(muscle, bones, state, poses[p].twists); }));
      reference_times.push_back(microseconds_of([&] {
        LanePlaces carried = lane_places(muscle.lanes, reference.places);
        carry_lanes(muscle.lanes, reference.bodies, poses[p].pose.bodies, carried);
        reference = {places_of(muscle.lanes, carried), poses[p].pose.bodies};
        NodeForces forces(muscle, bones, reference.bodies);
        relax_nodes(forces, {reference_iterations, reference_stop_move}, reference.places);
      }));
      const Real error = (state.places - reference.places).colwise().norm().mean();
      const Real length = std::abs(mean_length(muscle, state.places) - mean_length(muscle, reference.places));
      outcome.node_error += error / static_cast<Real>(poses.size());
      outcome.length_error += length / static_cast<Real>(poses.size());
      outcome.worst_pose_error = std::max(outcome.worst_pose_error, error);
      outcome.worst_length_error = std::max(outcome.worst_length_error, length);
    }
  }
  std::vector<Real> medians;
  for (const std::vector<Real>& of_pose : times) medians.push_back(median(of_pose));
  outcome.microseconds = median(medians), outcome.arms_microseconds = median(arms_times),
  outcome.reference_microseconds = median(reference_times);
  return outcome;
}

int run_all(int count, char** arguments) {
  CLI::App program("What strings cost and how near to rest they come");
  std::filesystem::path file;
  SceneOptions options;
  int repeats = 5;
  program.add_option("SCENE", file)->required();
  program.add_option("--data", options.data);
  program.add_option("--set", options.set)->allow_extra_args(false);
  program.add_option("--only", options.only)->delimiter(',')->allow_extra_args(false);
  program.add_option("--repeats", repeats);
  CLI11_PARSE(program, count, arguments);
  options.set.insert(options.set.begin(), "method=strings");
  const Scene scene = read_scene(file, options).scene;
  std::vector<StudyPose> poses;
  for (const Pose& pose : pose_sequence(scene)) poses.push_back({pose, joint_twists(scene, pose.coordinates)});
  const std::vector<DistanceField> fields = cached_bone_fields(scene, far_field_settings());
  const BoneDistances bones = bone_distances(scene, fields);
  fmt::print(
      "muscle,microseconds,arms_microseconds,reference_microseconds,node_error_mm,worst_node_error_mm,length_error_mm,"
      "worst_length_error_mm\n");
  Real sum = 0;
  for (const Muscle& muscle : scene.muscles) {
    const std::optional<MuscleStrings> strung =
        muscle_strings(scene, muscle, bones, muscle_settings<StringSettings>(scene, muscle));
    if (!strung) continue;
    const Outcome outcome = study(*strung, bones, poses, repeats);
    sum += outcome.microseconds;
    fmt::print("{},{:.1f},{:.1f},{:.0f},{:.4f},{:.4f},{:.4f},{:.4f}\n", muscle.name, outcome.microseconds,
               outcome.arms_microseconds, outcome.reference_microseconds, 1000 * outcome.node_error,
               1000 * outcome.worst_pose_error, 1000 * outcome.length_error, 1000 * outcome.worst_length_error);
    std::fflush(stdout);
  }
  fmt::print("all,{:.1f},,,,,\n", sum);
  return 0;
}

}  // namespace
}  // namespace gracilis::strings

int main(int count, char** arguments) {
  try {
    return gracilis::strings::run_all(count, arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
