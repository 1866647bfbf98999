#include <gracilis/opensim/kinematics/sample_motions.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/halton.hpp>
#include <gracilis/geometry/latin_hypercube.hpp>
#include <gracilis/opensim/kinematics/spread_points.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

static constexpr Real most_rows = 1e6;

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

/// All combinations of steps, as shares of the ranges; a row each.
static Eigen::MatrixXd grid(std::size_t angles, int steps) {
  const Real count = std::pow(steps + 1, static_cast<Real>(angles));
  if (count > most_rows)
    throw ConfigurationError({"--steps", "", fmt::format("a joint would take {} combinations", count),
                              "take fewer, or --combined halton --samples N"});
  Eigen::MatrixXd shares(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(angles));
  for (Eigen::Index row = 0; row < shares.rows(); ++row) {
    const std::vector<int> digits = combination(row, angles, steps);
    for (std::size_t i = 0; i < angles; ++i)
      shares(row, static_cast<Eigen::Index>(i)) = static_cast<Real>(digits[i]) / steps;
  }
  return shares;
}

/// Rows on the way from pose to pose, each of which is reached at rest.
static Eigen::MatrixXd on_the_way(const Eigen::MatrixXd& poses, const SampleSettings& settings) {
  if (!(settings.speed > 0)) return poses;
  constexpr Real fastest = 1.875;  // the steepest slope of 10 t³ - 15 t⁴ + 6 t⁵
  std::vector<Eigen::Index> rows;
  Real all = 1;
  for (Eigen::Index i = 1; i < poses.rows(); ++i) {
    const Real turn = (poses.row(i) - poses.row(i - 1)).cwiseAbs().maxCoeff();
    const Real wanted = std::ceil(fastest * turn / (settings.speed * settings.time_step) - 1e-9);
    all += wanted;
    if (!(all <= most_rows))
      throw ConfigurationError({"--speed", "", "a motion would take more than a million rows",
                                "take fewer poses, a larger --time-step or a higher --speed"});
    rows.push_back(static_cast<Eigen::Index>(wanted));
  }
  Eigen::MatrixXd result(static_cast<Eigen::Index>(all), poses.cols());
  result.row(0) = poses.row(0);
  Eigen::Index at = 1;
  for (Eigen::Index i = 1; i < poses.rows(); ++i) {
    const Eigen::Index count = rows[static_cast<std::size_t>(i) - 1];
    for (Eigen::Index k = 1; k <= count; ++k) {
      const Real t = static_cast<Real>(k) / static_cast<Real>(count);
      const Real share = t * t * t * (10 + t * (6 * t - 15));
      if (k == count)
        result.row(at++) = poses.row(i);  // with no rounding
      else
        result.row(at++) = (1 - share) * poses.row(i - 1) + share * poses.row(i);
    }
  }
  return result;
}

static std::pair<Real, Real> range_of(const Coordinate& coordinate, const SampleSettings& settings) {
  const auto given = settings.ranges.find(coordinate.name);
  return given == settings.ranges.end() ? std::pair(coordinate.range_min, coordinate.range_max) : given->second;
}

/// These coordinates through poses that are shares of their ranges.
static CoordinateMotion through(const Model& model, const std::vector<Index>& angles, const Eigen::MatrixXd& shares,
                                const SampleSettings& settings) {
  Eigen::MatrixXd poses(shares.rows(), shares.cols());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto [low, high] = range_of(model.coordinates[static_cast<std::size_t>(angles[i])], settings);
    const auto column = static_cast<Eigen::Index>(i);
    poses.col(column) = (low + shares.col(column).array() * (high - low)).matrix();
  }
  const Eigen::MatrixXd rows = on_the_way(poses, settings);
  CoordinateMotion motion;
  motion.values = default_coordinates(model).transpose().replicate(rows.rows(), 1);
  for (Eigen::Index row = 0; row < rows.rows(); ++row)
    motion.times.push_back(settings.time_step * static_cast<Real>(row));
  std::vector<bool> held(model.coordinates.size(), false);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    motion.values.col(angles[i]) = rows.col(static_cast<Eigen::Index>(i));
    held[static_cast<std::size_t>(angles[i])] = true;
  }
  complete_rows(model, held, motion);
  return motion;
}

/// Combined poses as shares of the ranges.
static Eigen::MatrixXd combined_shares(const Model& model, const std::vector<Index>& angles,
                                       const SampleSettings& settings) {
  const auto columns = static_cast<Index>(angles.size());
  if (settings.combined == CombinedPoses::grid) return grid(angles.size(), settings.steps);
  if (settings.samples > 20'000)
    throw ConfigurationError({"--samples", "", "more than 20000 poses are too many to put in an order", ""});
  Eigen::RowVectorXd begin(columns);
  for (Index i = 0; i < columns; ++i) {
    const Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(angles[static_cast<std::size_t>(i)])];
    const auto [low, high] = range_of(coordinate, settings);
    begin[i] = high > low ? (coordinate.default_value - low) / (high - low) : 0;
  }
  return nearest_next(settings.combined == CombinedPoses::halton
                          ? halton_points(settings.samples, columns)
                          : latin_hypercube(settings.samples, columns, settings.seed),
                      begin);
}

std::vector<SampleMotion> sample_motions(const Model& model, const Joint& joint, const SampleSettings& settings) {
  std::vector<SampleMotion> motions;
  const std::vector<Index> angles = free_angles(model, joint);
  for (const Index i : angles)
    motions.push_back({joint.name + "_" + model.coordinates[static_cast<std::size_t>(i)].name,
                       through(model, {i}, grid(1, settings.steps), settings)});
  if (angles.size() > 1 && settings.combined != CombinedPoses::none)
    motions.push_back(
        {joint.name + "_combined", through(model, angles, combined_shares(model, angles, settings), settings)});
  return motions;
}

}  // namespace gracilis::opensim
