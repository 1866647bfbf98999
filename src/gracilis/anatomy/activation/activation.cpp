#include <gracilis/anatomy/activation/activation.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>

#include <algorithm>
#include <cassert>

namespace gracilis {

/// Linear between rows of ascending x, constant beyond.
static Real interpolated(const std::vector<Real>& x, const std::vector<Real>& y, Real at) {
  if (x.empty()) return 0;
  const auto above = std::upper_bound(x.begin(), x.end(), at);
  if (above == x.begin()) return y.front();
  if (above == x.end()) return y.back();
  const auto i = static_cast<std::size_t>(above - x.begin());
  return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
}

Real value_at(const ActivationSignal& signal, Real time) { return interpolated(signal.times, signal.values, time); }

ActivationDriver::ActivationDriver(const Scene& scene) : scene_(scene) {
  const std::vector<std::string> names = coordinate_names(scene);
  for (const JointControlUnit& unit : scene.activation.units) {
    Unit prepared{JointControl(unit), {}, {}};
    for (const std::string& coordinate : unit.coordinates) {
      const auto found = std::find(names.begin(), names.end(), coordinate);
      assert(found != names.end());
      prepared.coordinates.push_back(static_cast<std::size_t>(found - names.begin()));
    }
    for (const std::string& muscle : unit.muscles) prepared.muscles.push_back(muscle_index(muscle));
    units_.push_back(std::move(prepared));
  }
}

std::size_t ActivationDriver::muscle_index(const std::string& name) const {
  const auto found =
      std::find_if(scene_.muscles.begin(), scene_.muscles.end(), [&](const Muscle& m) { return m.name == name; });
  return static_cast<std::size_t>(found - scene_.muscles.begin());
}

std::vector<Real> ActivationDriver::at(const Pose& pose) const {
  std::vector<Real> activations(scene_.muscles.size(), 0);
  const auto set = [&](std::size_t muscle, Real value) {
    if (muscle < activations.size()) activations[muscle] = std::clamp(value, Real{0}, Real{1});
  };
  for (const ActivationSignal& signal : scene_.activation.signals)
    set(muscle_index(signal.muscle), value_at(signal, pose.time));
  for (const ActivationOfPose& function : scene_.activation.functions)
    set(muscle_index(function.muscle), function.value(pose));
  for (const Unit& unit : units_) {
    Eigen::VectorXd angles(static_cast<Index>(unit.coordinates.size()));
    for (std::size_t i = 0; i < unit.coordinates.size(); ++i)
      angles[static_cast<Index>(i)] = pose.coordinates[unit.coordinates[i]];
    const Eigen::VectorXd values = unit.control.at(angles);
    for (std::size_t i = 0; i < unit.muscles.size(); ++i) set(unit.muscles[i], values[static_cast<Index>(i)]);
  }
  return activations;
}

void set_activations(const Scene& scene, std::vector<Pose>& poses) {
  const ActivationDriver driver(scene);
  for (Pose& pose : poses) pose.activations = driver.at(pose);
}

std::function<Real(const Pose&)> along_coordinate(std::size_t coordinate, const Eigen::MatrixX2d& points) {
  const std::vector<Real> x(points.col(0).begin(), points.col(0).end()), y(points.col(1).begin(), points.col(1).end());
  return [=](const Pose& pose) { return interpolated(x, y, pose.coordinates[coordinate]); };
}

}  // namespace gracilis
