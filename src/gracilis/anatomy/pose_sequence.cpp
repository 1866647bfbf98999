#include <gracilis/anatomy/pose_sequence.hpp>

#include <gracilis/anatomy/activation.hpp>
#include <gracilis/anatomy/joint_pose.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

using Coordinates = std::vector<Real>;

/// The motion's rows with the coordinates in the order of the scene.
static std::vector<Coordinates> motion_rows(const Scene& scene) {
  const std::vector<std::string> names = coordinate_names(scene);
  std::vector<Coordinates> rows(scene.motion.times.size(), capture_coordinates(scene));
  for (std::size_t column = 0; column < scene.motion.coordinates.size(); ++column) {
    const auto found = std::find(names.begin(), names.end(), scene.motion.coordinates[column]);
    if (found == names.end()) continue;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      rows[row][found - names.begin()] = scene.motion.values(row, column);
    }
  }
  return rows;
}

/// Equal steps from one set of values to another; without the first, with the last exactly.
static std::vector<Coordinates> ramp(const Scene& scene, const Coordinates& from, const Coordinates& to, int frames) {
  if (from == to) return {};
  if (frames == 0) {
    Real largest = 0;
    std::size_t i = 0;
    for (const Joint& joint : scene.joints)
      for (const JointAxis& axis : joint.axes) {
        largest = std::max(largest, shown_value(axis, std::abs(to[i] - from[i])));
        ++i;
      }
    // The tolerance keeps a change of exactly n degrees (or mm) at n frames whatever the rounding.
    frames = std::max(1, static_cast<int>(std::ceil(largest - 1e-9)));
  }
  std::vector<Coordinates> steps(frames, to);
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
  std::vector<Coordinates> into = ramp(scene, capture, rows.front(), scene.sequence.ramp_frames);
  into.insert(into.end(), static_cast<std::size_t>(std::max(scene.sequence.settle_frames, 0)), rows.front());
  add(capture, times.front() - spacing * Real(into.size()));
  for (std::size_t i = 0; i < into.size(); ++i) add(into[i], times.front() - spacing * Real(into.size() - 1 - i));
  for (std::size_t i = 1; i < rows.size(); ++i) add(rows[i], times[i]);
  for (int i = 0; i < scene.sequence.hold_frames; ++i) add(rows.back(), poses.back().time + spacing);
  if (scene.sequence.return_to_capture) {
    for (const Coordinates& values : ramp(scene, rows.back(), capture, scene.sequence.ramp_frames)) {
      add(values, poses.back().time + spacing);
    }
  }
  return poses;
}

std::vector<Pose> pose_sequence(const Scene& scene) {
  std::vector<Pose> poses = relaxed_sequence(scene);
  set_activations(scene, poses);
  return poses;
}

}  // namespace gracilis
