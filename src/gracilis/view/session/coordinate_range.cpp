#include <gracilis/view/session/coordinate_range.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/scene/motion.hpp>
#include <gracilis/scene/names.hpp>
#include <gracilis/simulate/moment_arm_curves.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

static const JointAxis& axis_called(const Scene& scene, const std::string& coordinate) {
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes)
      if (axis.coordinate == coordinate) return axis;
  throw ConfigurationError(
      {"--coord", "", "there is no coordinate '" + coordinate + "'", suggestion(coordinate, coordinate_names(scene))});
}

CoordinateRange parse_coordinate_range(const std::string& text) {
  const auto wrong = [&](const std::string& what) {
    return ConfigurationError({"--coord", "", "'" + text + "' " + what,
                               "write NAME=FROM:TO:STEP or NAME=VALUE, in degrees, or mm for a translation"});
  };
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw wrong("names no coordinate");
  std::vector<Real> numbers;
  for (std::size_t begin = equals + 1; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    double value = 0;
    if (!parse_number(std::string_view(text).substr(begin, end - begin), value) || !std::isfinite(value))
      throw wrong("holds something that is no number");
    numbers.push_back(value);
    begin = end + 1;
  }
  CoordinateRange range{text.substr(0, equals), numbers[0], numbers[0], 0};
  if (numbers.size() == 1) return range;
  if (numbers.size() != 3) throw wrong("has " + std::to_string(numbers.size()) + " numbers");
  range.to = numbers[1];
  range.step = numbers[2];
  if (!(range.step > 0) || range.from == range.to) throw wrong("goes nowhere");
  return range;
}

std::vector<MovedCoordinate> move_through(const std::vector<CoordinateRange>& ranges, LoadedScene& loaded) {
  std::vector<std::string> names;
  std::vector<Eigen::VectorXd> values;
  std::vector<MovedCoordinate> moved;
  for (const CoordinateRange& range : ranges) {
    const bool translation = axis_called(loaded.scene, range.name).translation;
    const Real unit = translation ? 0.001 : radians(1);
    if (std::find(names.begin(), names.end(), range.name) != names.end())
      throw ConfigurationError({"--coord", "", "the coordinate '" + range.name + "' is given twice", ""});
    if (range.moves()) moved.push_back({range.name, translation});
    names.push_back(range.name);
    values.push_back(range.moves()
                         ? values_through(range.from * unit, range.to * unit, range.step * unit, loaded.max_frames)
                         : Eigen::VectorXd::Constant(1, range.from * unit));
  }
  if (moved.empty()) throw ConfigurationError({"--coord", "", "no coordinate moves", "write one as NAME=FROM:TO:STEP"});
  set_range(loaded.scene, motion_over_grid(names, values, 1.0 / 60, loaded.max_frames));
  return moved;
}

std::filesystem::path range_folder(const Scene& scene) {
  return std::filesystem::path("runs") / (file_name_of(scene.name) + "_rom");
}

}  // namespace gracilis
