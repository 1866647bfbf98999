#include <gracilis/simulate/moment_arm_curves.hpp>

#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/simulate/moment_arms.hpp>
#include <gracilis/simulate/run.hpp>

#include <numeric>
#include <utility>

namespace gracilis {

static constexpr int usual_settle_frames = 30;

void set_range(Scene& scene, Motion range) {
  scene.motion = std::move(range);
  scene.motion.name = scene.name;
  if (scene.sequence.settle_frames == 0) scene.sequence.settle_frames = usual_settle_frames;
  scene.sequence.hold_frames = 0;
  scene.sequence.return_to_capture = false;
}

/// Frame 0 and those of the motion.
static std::vector<int> frames_of_range(const SequenceParts& parts) {
  std::vector<int> frames(static_cast<std::size_t>(parts.motion));
  std::iota(frames.begin(), frames.end(), parts.first_of_motion());
  if (frames.front() != 0) frames.insert(frames.begin(), 0);
  return frames;
}

MomentArmCurves moment_arm_curves(const Scene& scene, Index coordinate, DeformationMethod& method,
                                  const FiberTracker& tracker, int max_frames, const std::atomic<bool>& stop,
                                  const std::function<void(Index, const Frame&)>& look) {
  std::vector<std::size_t> numbers;
  MomentArmCurves curves;
  for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
    if (tracker.rest(m).count() == 0) continue;
    numbers.push_back(m);
    curves.muscles.push_back(scene.muscles[m].name);
  }
  const auto rows = static_cast<Index>(scene.motion.times.size()), muscles = static_cast<Index>(numbers.size());
  curves.values.resize(rows);
  curves.lengths.resize(rows, muscles);
  Eigen::MatrixXd known(rows, muscles);
  std::vector<char> is_known(numbers.size(), 0);
  RunChoices choices;
  choices.fiber_actions = true;
  choices.measures = MeasureLevel::none;
  choices.recorded = frames_of_range(sequence_parts(scene, max_frames));
  const Index before = static_cast<Index>(choices.recorded.size()) - rows;
  const auto record = [&](const FrameRecord& now) {
    const Index row = now.frame.number - before;
    if (row < 0) return;
    if (look) look(row, now.frame);
    curves.values(row) = now.frame.pose.coordinates[static_cast<std::size_t>(coordinate)];
    for (Index i = 0; i < muscles; ++i) {
      const std::size_t m = numbers[static_cast<std::size_t>(i)];
      curves.lengths(row, i) = now.fibers[m].mean_length;
      if (m >= now.actions.size() || now.actions[m].mean_arms.size() == 0) continue;
      known(row, i) = now.actions[m].mean_arms(coordinate);
      is_known[static_cast<std::size_t>(i)] = 1;
    }
  };
  if (run_scene(scene, pose_sequence(scene, max_frames), method, nullptr, stop, record, &tracker, choices) ==
      RunEnd::interrupted)
    throw Interrupted();
  curves.arms = moment_arms(curves.values, curves.lengths);
  for (Index i = 0; i < muscles; ++i)
    if (is_known[static_cast<std::size_t>(i)]) curves.arms.col(i) = known.col(i);
  return curves;
}

}  // namespace gracilis
