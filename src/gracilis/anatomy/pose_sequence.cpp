#include <gracilis/anatomy/pose_sequence.hpp>

#include <gracilis/anatomy/activation/activation.hpp>
#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/joints/joint_twists.hpp>
#include <gracilis/scene/motion.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

using Coordinates = std::vector<Real>;

/// A row of the motion with the coordinates in the order of the scene.
static Coordinates motion_row(const Scene& scene, std::size_t row) {
  const std::vector<std::string> names = coordinate_names(scene);
  Coordinates values = capture_coordinates(scene);
  for (std::size_t column = 0; column < scene.motion.coordinates.size(); ++column) {
    const auto found = std::find(names.begin(), names.end(), scene.motion.coordinates[column]);
    if (found != names.end())
      values[static_cast<std::size_t>(found - names.begin())] =
          scene.motion.values(static_cast<Index>(row), static_cast<Index>(column));
  }
  return values;
}

static std::vector<Coordinates> motion_rows(const Scene& scene) {
  std::vector<Coordinates> rows;
  for (std::size_t row = 0; row < scene.motion.times.size(); ++row) rows.push_back(motion_row(scene, row));
  return rows;
}

/// Per joint: whether it moves all that muscles and bones hang on alike, which deforms nothing.
static std::vector<bool> carries_all(const Scene& scene) {
  std::vector<bool> used(scene.bodies.size(), false);
  for (const Bone& bone : scene.bones) used[static_cast<std::size_t>(bone.body)] = true;
  for (const Muscle& muscle : scene.muscles)
    for (const Attachment& attachment : muscle.attachments) used[static_cast<std::size_t>(attachment.body)] = true;
  if (std::find(used.begin(), used.end(), true) == used.end()) return std::vector<bool>(scene.joints.size(), false);
  std::vector<bool> carries;
  for (const Joint& joint : scene.joints) {
    bool all = true;
    for (std::size_t body = 0; body < used.size(); ++body)
      all = all && (!used[body] || hangs_on(scene, static_cast<Index>(body), joint));
    carries.push_back(all);
  }
  return carries;
}

/// How many frames a ramp takes: what the scene says, or as many as steps of 1 degree (or mm) need of what
/// moves bodies against each other.
static std::int64_t ramp_length(const Scene& scene, const Coordinates& from, const Coordinates& to) {
  if (from == to) return 0;
  if (scene.sequence.ramp_frames > 0) return scene.sequence.ramp_frames;
  const std::vector<bool> free = carries_all(scene);
  Real largest = 0;
  std::size_t i = 0;
  for (std::size_t j = 0; j < scene.joints.size(); ++j)
    for (const JointAxis& axis : scene.joints[j].axes) {
      if (!free[j]) largest = std::max(largest, shown_value(axis, std::abs(to[i] - from[i])));
      ++i;
    }
  return steps_over(largest, 1);
}

SequenceParts sequence_parts(const Scene& scene, int max_frames) {
  const auto bounded = [&](std::int64_t frames) {
    require_frames(frames, max_frames);
    return static_cast<int>(frames);
  };
  SequenceParts parts;
  const std::size_t rows = scene.motion.times.size();
  if (rows == 0) return parts;
  const Coordinates capture = capture_coordinates(scene);
  parts.motion = bounded(static_cast<std::int64_t>(rows));
  parts.ramp = bounded(ramp_length(scene, capture, motion_row(scene, 0)));
  if (scene.sequence.return_to_capture) parts.back = bounded(ramp_length(scene, motion_row(scene, rows - 1), capture));
  parts.settle = std::max(scene.sequence.settle_frames, 0);
  parts.hold = std::max(scene.sequence.hold_frames, 0);
  bounded(std::int64_t{parts.motion} + parts.ramp + parts.back + parts.settle + parts.hold);
  return parts;
}

/// Equal steps from one set of values to another; without the first, with the last exactly.
static std::vector<Coordinates> ramp(const Scene& scene, const Coordinates& from, const Coordinates& to) {
  const auto frames = static_cast<int>(ramp_length(scene, from, to));
  std::vector<Coordinates> steps(static_cast<std::size_t>(frames), to);
  for (int step = 0; step + 1 < frames; ++step) {
    const Real share = Real(step + 1) / frames;
    for (std::size_t i = 0; i < to.size(); ++i) steps[step][i] = from[i] + share * (to[i] - from[i]);
  }
  return steps;
}

static Real mean_spacing(const std::vector<Real>& times) {
  return times.size() < 2 ? 1.0 / 60 : (times.back() - times.front()) / Real(times.size() - 1);
}

static std::vector<Pose> relaxed_sequence(const Scene& scene) {
  const Coordinates capture = capture_coordinates(scene);
  const std::vector<Coordinates> rows = motion_rows(scene);
  std::vector<Pose> poses;
  const auto add = [&](const Coordinates& values, Real time) {
    poses.push_back(pose_at(scene, values));
    poses.back().time = time;
  };
  if (rows.empty()) {
    add(capture, 0);
    return poses;
  }

  const std::vector<Real>& times = scene.motion.times;
  const Real spacing = mean_spacing(times);

  // A motion that starts in the capture pose has that row as its frame 0.
  std::vector<Coordinates> into = ramp(scene, capture, rows.front());
  into.insert(into.end(), static_cast<std::size_t>(std::max(scene.sequence.settle_frames, 0)), rows.front());
  add(capture, times.front() - spacing * Real(into.size()));
  for (std::size_t i = 0; i < into.size(); ++i) add(into[i], times.front() - spacing * Real(into.size() - 1 - i));
  for (std::size_t i = 1; i < rows.size(); ++i) add(rows[i], times[i]);
  for (int i = 0; i < scene.sequence.hold_frames; ++i) add(rows.back(), poses.back().time + spacing);
  if (scene.sequence.return_to_capture) {
    for (const Coordinates& values : ramp(scene, rows.back(), capture)) {
      add(values, poses.back().time + spacing);
    }
  }
  return poses;
}

std::vector<Pose> pose_sequence(const Scene& scene, int max_frames) {
  sequence_parts(scene, max_frames);
  std::vector<Pose> poses = relaxed_sequence(scene);
  set_activations(scene, poses);
  return poses;
}

std::vector<int> recorded_frames(const SequenceParts& parts, int every, bool with_ramps) {
  const int first = with_ramps ? 0 : parts.first_of_motion(), end = parts.count() - (with_ramps ? 0 : parts.back);
  std::vector<int> frames = {0};
  for (int frame = first == 0 ? every : first; frame < end; frame += every) frames.push_back(frame);
  if (frames.back() != end - 1) frames.push_back(end - 1);
  return frames;
}

}  // namespace gracilis
