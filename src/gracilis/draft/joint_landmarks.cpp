#include <gracilis/draft/joint_landmarks.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/rotations.hpp>

#include <algorithm>

namespace gracilis {
namespace {

constexpr Real one_place = 0.001;  // m, within which two landmarks tell no direction

/// The fitted joint, or, where the surfaces do not show it, the body's directions, which a ball has in any case.
JointFit without_landmarks(const JointQuestion& q) {
  const bool ball = q.joint.kind == JointKind::ball;
  if (const std::optional<JointFit> fit = ball ? std::nullopt : fit_joint(q)) return *fit;
  return {Vec3::Zero(), body_axes(q), "the body's directions",
          ball ? q.frame.certainty : std::min(q.frame.certainty, 0.5)};
}

Vec3 line_through(const Points& landmarks, const JointQuestion& q) {
  const Vec3 line = landmarks.col(1) - landmarks.col(0);
  if (line.norm() < one_place)
    throw ConfigurationError({"--joint", "",
                              "the two landmarks of '" + q.joint.name + side_ending(q.side) + "' lie at one place",
                              "name two on the joint's axis, on both sides of it, or one at its center"});
  return line.normalized();
}

/// Turns the axes together, so that they keep their angles, until the first one lies along the line.
void turn_to(const Vec3& line, std::vector<Vec3>& axes) {
  const Vec3 first = axes.front();
  const Eigen::Quaterniond turn = turn_from_to(first, line.dot(first) < 0 ? Vec3(-line) : line);
  for (Vec3& axis : axes) axis = turn * axis;
}

}  // namespace

JointFit joint_at(const Points& landmarks, const JointQuestion& question) {
  JointFit fit = without_landmarks(question);
  fit.center = landmarks.rowwise().mean();
  if (landmarks.cols() < 2) {
    fit.how = "its center by a landmark, its axes by " + fit.how;
    return fit;
  }
  fit.how = "the line through two landmarks" + (fit.axes.size() < 2 ? "" : ", other axes by " + fit.how);
  if (fit.axes.size() < 2) fit.certainty = 1;
  turn_to(line_through(landmarks, question), fit.axes);
  return fit;
}

}  // namespace gracilis
