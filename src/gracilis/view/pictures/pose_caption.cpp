#include <gracilis/view/pictures/pose_caption.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/words_of_name.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

/// How many coordinates a caption has room for.
constexpr Index most_captioned = 3;
/// Degrees or mm; less cannot be seen.
constexpr Real least_motion = 0.5;

/// Frames before the motion have times that say nothing.
std::string time_words(const CaptionedFrames& frames, int frame) {
  const Real time = frames.times[static_cast<std::size_t>(frame)];
  if (frame < frames.first_motion_frame || time < 0) return "on the way to the motion";
  return fmt::format("{:.2f} s", time);
}

CoordinateLabel label_of_axis(const JointAxis& axis) { return {axis.coordinate, axis.translation ? " mm" : "°"}; }

void append_value(const CoordinateLabel& label, Real value, std::string& caption) {
  // Rounded first: no "-0".
  caption += fmt::format("{}{} {:.0f}{}", caption.empty() ? "" : ", ", words_of_name(label.name),
                         std::round(value) + 0.0, label.unit);
}

Eigen::RowVectorXd ranges_of(const CaptionedFrames& frames) {
  if (frames.values.size() == 0) return {};
  return frames.values.colwise().maxCoeff() - frames.values.colwise().minCoeff();
}

/// All frames of a run are named alike. Where nothing moves, as while activations rise, time tells them apart.
bool are_told_by_time(const CaptionedFrames& frames) {
  const Index moving = (ranges_of(frames).array() >= least_motion).count();
  return moving == 0 || moving > most_captioned;
}

}  // namespace

CaptionedFrames captioned_frames(const RecordedRun& run) {
  CaptionedFrames frames;
  for (const std::string& column : run.coordinates) frames.coordinates.push_back(coordinate_label(column));
  frames.values = run.coordinate_values;
  frames.times = run.times;
  frames.first_motion_frame = run.first_motion_frame;
  return frames;
}

CaptionedFrames captioned_frames(const Scene& scene, const std::vector<Pose>& poses) {
  CaptionedFrames frames;
  std::vector<const JointAxis*> axes;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes) {
      axes.push_back(&axis);
      frames.coordinates.push_back(label_of_axis(axis));
    }
  frames.values.resize(static_cast<Index>(poses.size()), static_cast<Index>(axes.size()));
  const Real begin = scene.motion.times.empty() ? 0 : scene.motion.times.front();
  for (std::size_t f = 0; f < poses.size(); ++f) {
    const std::vector<Real>& coordinates = poses[f].coordinates;
    for (std::size_t c = 0; c < axes.size(); ++c)
      frames.values(static_cast<Index>(f), static_cast<Index>(c)) =
          shown_value(*axes[c], c < coordinates.size() ? coordinates[c] : axes[c]->capture_value);
    frames.times.push_back(poses[f].time);
    frames.first_motion_frame += poses[f].time < begin ? 1 : 0;
  }
  return frames;
}

std::string pose_words(const CaptionedFrames& frames, int frame) {
  if (frame == 0) return "capture pose";
  if (are_told_by_time(frames)) return time_words(frames, frame);
  const Eigen::MatrixXd& values = frames.values;
  Eigen::Index main = 0;
  ranges_of(frames).maxCoeff(&main);
  std::string caption;
  for (Index i = 0; i < values.cols(); ++i) {
    const Real value = values(frame, i);
    // A motion of one coordinate sets the others to 0.
    const bool left = std::abs(value - values(0, i)) >= least_motion && std::abs(value) >= least_motion;
    if (!left && i != main) continue;
    append_value(frames.coordinates[static_cast<std::size_t>(i)], value, caption);
  }
  return caption;
}

std::string pose_caption(const CaptionedFrames& frames, int frame) {
  const std::string words = pose_words(frames, frame);
  return frame > 0 && are_told_by_time(frames) ? fmt::format("frame {}, {}", frame, words) : words;
}

std::string pose_caption(const Scene& scene, const Frame& frame) {
  if (frame.number == 0) return "capture pose";
  std::string caption;
  std::size_t coordinate = 0;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes) {
      const Real now = shown_value(axis, frame.pose.coordinates[coordinate]);
      if (coordinate++ == 0 || std::abs(now - shown_value(axis, axis.capture_value)) > least_motion)
        append_value(label_of_axis(axis), now, caption);
    }
  return caption;
}

}  // namespace gracilis
