#include "asked_step.hpp"

#include "errors.hpp"
#include "scene_handle.hpp"

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/suggestions.hpp>

#include <algorithm>
#include <cmath>

namespace py = pybind11;

namespace gracilis::python {

namespace {

struct CoordinateAxis {
  std::size_t number;
  const JointAxis* axis;
};

CoordinateAxis axis_named(const Scene& scene, const std::string& name) {
  std::size_t number = 0;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes) {
      if (axis.coordinate == name) return {number, &axis};
      ++number;
    }
  throw ConfigurationError(
      {"", "", "there is no coordinate '" + name + "'", suggestion(name, coordinate_names(scene))});
}

/// Puts what a dict says of coordinates into `coordinates`, in degrees and mm or else in rad and m.
void ask(const Scene& scene, const py::dict& values, bool in_degrees, std::vector<Real>& coordinates) {
  for (const auto& [key, value] : values) {
    const std::string name = py::str(key).cast<std::string>();
    const CoordinateAxis found = axis_named(scene, name);
    const Real unit = !in_degrees ? 1 : found.axis->translation ? 0.001 : radians(1);
    coordinates[found.number] = number_of(value, name) * unit;
  }
}

/// Whether a pose means here what it means where it comes from, to the last bit.
bool is_pose_of(const Scene& scene, const MotionPose& asked) {
  const Scene& other = asked.of->scene;
  const auto have_one_name = [](const Muscle& a, const Muscle& b) { return a.name == b.name; };
  const auto are_equal = [](const RigidTransform& a, const RigidTransform& b) { return a.matrix() == b.matrix(); };
  return coordinate_names(scene) == coordinate_names(other) &&
         std::ranges::equal(scene.muscles, other.muscles, have_one_name) &&
         std::ranges::equal(pose_at(scene, asked.pose.coordinates).bodies, asked.pose.bodies, are_equal);
}

AskedStep step_of_motion(const LiveState& state, const MotionPose& asked, std::optional<Real> time_step) {
  if (!is_pose_of(state.scene(), asked)) refuse("pose", "is of another scene", "take one of this scene's poses");
  AskedStep step{asked.pose, time_step.value_or(asked.time_step)};
  if (time_step) step.pose.time = state.frame().pose.time + *time_step;
  step.pose.activations.resize(state.activations.size());
  for (std::size_t m = 0; m < state.activations.size(); ++m)
    if (!state.planned[m]) step.pose.activations[m] = state.activations[m];
  return step;
}

}  // namespace

Real number_of(const py::handle& value, const std::string& name) {
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred()) {
    PyErr_Clear();
    refuse(name, "must be a number");
  }
  if (!std::isfinite(number)) refuse(name, "must be finite");
  return number;
}

AskedStep asked_step(const LiveState& state, const py::object& pose, const py::dict& radians,
                     std::optional<Real> time_step) {
  if (time_step && (!(*time_step > 0) || !std::isfinite(*time_step))) refuse("time_step", "must be above 0 s");
  if (py::isinstance<MotionPose>(pose)) {
    if (!radians.empty()) refuse("radians", "has no place beside one of Scene.poses, which brings all coordinates");
    return step_of_motion(state, pose.cast<const MotionPose&>(), time_step);
  }
  if (!pose.is_none() && !py::isinstance<py::dict>(pose))
    refuse("pose", "must be a dict of degrees (mm for translations) by coordinates' names, or one of Scene.poses");
  AskedStep step{{}, time_step.value_or(usual_time_step)};
  step.pose.time = state.frame().pose.time + step.time_step;
  step.pose.coordinates = state.coordinates;
  step.pose.activations = state.activations;
  if (!pose.is_none()) ask(state.scene(), py::reinterpret_borrow<py::dict>(pose), true, step.pose.coordinates);
  ask(state.scene(), radians, false, step.pose.coordinates);
  return step;
}

}  // namespace gracilis::python
