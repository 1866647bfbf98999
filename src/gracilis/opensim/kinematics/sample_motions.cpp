#include <gracilis/opensim/kinematics/sample_motions.hpp>

#include <gracilis/core/errors.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

static std::vector<Index> free_angles(const Model& model, const Joint& joint) {
  std::vector<Index> angles;
  for (const Index i : joint.coordinates) {
    const Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(i)];
    const bool dependent = std::any_of(model.couplers.begin(), model.couplers.end(),
                                       [&](const Coupler& coupler) { return coupler.dependent == i; });
    if (coordinate.rotation && !coordinate.locked && !dependent) angles.push_back(i);
  }
  return angles;
}

/// Row `row` of all combinations of so many digits from 0 to `steps`, in the order in which neighbors differ by one.
static std::vector<int> combination(long long row, std::size_t digits, int steps) {
  std::vector<int> result(digits);
  for (std::size_t i = digits; i-- > 0;) {
    const auto digit = static_cast<int>(row % (steps + 1));
    row /= steps + 1;
    result[i] = row % 2 == 0 ? digit : steps - digit;  // there and back again as the digits before it go on
  }
  return result;
}

/// All combinations of values of these coordinates.
static CoordinateMotion combined(const Model& model, const std::vector<Index>& angles, int steps) {
  const Real count = std::pow(steps + 1, static_cast<Real>(angles.size()));
  if (count > 1e6)
    throw ConfigurationError({"--steps", "", fmt::format("a joint would take {} combinations", count), "take fewer"});
  CoordinateMotion motion;
  const auto rows = static_cast<Eigen::Index>(count);
  motion.values = default_coordinates(model).transpose().replicate(rows, 1);
  for (Eigen::Index row = 0; row < rows; ++row) {
    motion.times.push_back(0.01 * static_cast<Real>(row));
    const std::vector<int> digits = combination(row, angles.size(), steps);
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(angles[i])];
      const Real share = static_cast<Real>(digits[i]) / steps;
      motion.values(row, angles[i]) = coordinate.range_min + share * (coordinate.range_max - coordinate.range_min);
    }
  }
  std::vector<bool> held(model.coordinates.size(), false);
  for (const Index i : angles) held[static_cast<std::size_t>(i)] = true;
  complete_rows(model, held, motion);
  return motion;
}

std::vector<SampleMotion> sample_motions(const Model& model, const Joint& joint, int steps) {
  std::vector<SampleMotion> motions;
  const std::vector<Index> angles = free_angles(model, joint);
  for (const Index i : angles)
    motions.push_back(
        {joint.name + "_" + model.coordinates[static_cast<std::size_t>(i)].name, combined(model, {i}, steps)});
  if (angles.size() > 1) motions.push_back({joint.name + "_combined", combined(model, angles, steps)});
  return motions;
}

}  // namespace gracilis::opensim
