#include <gracilis/opensim/export/muscle_points.hpp>

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>
#include <gracilis/opensim/reader/crossed_coordinates.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis::opensim {

/// The coordinates that points of the muscle may follow.
static std::vector<FollowedCoordinate> followed_coordinates(const Model& model, const Muscle* known,
                                                            const Eigen::MatrixXd& values) {
  std::vector<FollowedCoordinate> followed;
  for (std::size_t i = 0; i < model.coordinates.size(); ++i) {
    const auto column = values.col(static_cast<Eigen::Index>(i));
    // What hardly moves tells nothing about how points would follow it.
    const Real enough = model.coordinates[i].rotation ? radians(5) : 0.005;
    if (column.maxCoeff() - column.minCoeff() > enough)
      followed.push_back({static_cast<Index>(i), {column.begin(), column.end()}});
  }
  if (!known) return followed;
  const std::vector<Index> crossed = crossed_coordinates(model, known->path);
  std::erase_if(followed, [&](const FollowedCoordinate& each) {
    return std::find(crossed.begin(), crossed.end(), each.coordinate) == crossed.end();
  });
  return followed;
}

PathErrors point_errors(Skeleton& skeleton, const Path& path, const Path* own, const KnownFibers& known) {
  const LengthSamples& run = known.samples;
  const MuscleLengths& muscle = run.muscles[0];
  const std::vector<Points>& fibers = known.lines;
  PathErrors errors;
  Eigen::Index arm_count = 0;
  for (std::size_t f = 0; f < fibers.size(); ++f) {
    const auto row = static_cast<Eigen::Index>(f);
    const Eigen::VectorXd coordinates = run.coordinates.row(row);
    skeleton.place(coordinates);
    const PathMeasure measure = measure_path(skeleton, path, coordinates);
    const Real off = measure.length - polyline_length(fibers[f]);
    errors.length_root_mean_square += off * off;
    errors.length_largest = std::max(errors.length_largest, std::abs(off));
    Eigen::VectorXd others;
    if (muscle.arms.cols() > 0)
      others = muscle.arms.row(row);
    else if (own)
      others = measure_path(skeleton, *own, coordinates).moment_arms;
    for (Eigen::Index i = 0; i < others.size(); ++i) {
      if (!skeleton.model().coordinates[static_cast<std::size_t>(i)].rotation) continue;
      if (std::abs(others[i]) < 1e-6 && std::abs(measure.moment_arms[i]) < 1e-6) continue;
      const Real arm_off = std::abs(measure.moment_arms[i] - others[i]);
      errors.arm_root_mean_square += arm_off * arm_off;
      errors.arm_largest = std::max(errors.arm_largest, arm_off);
      ++arm_count;
    }
  }
  const auto root = [](Real sum, Real count) { return count > 0 ? std::sqrt(sum / count) : 0; };
  errors.length_root_mean_square = root(errors.length_root_mean_square, static_cast<Real>(fibers.size()));
  errors.arm_root_mean_square = root(errors.arm_root_mean_square, static_cast<Real>(arm_count));
  return errors;
}

/// Evenly chosen points of each line, its ends among them.
static std::vector<Points> fewer_points(const std::vector<Points>& lines, Eigen::Index count) {
  std::vector<Eigen::Index> kept;
  const Eigen::Index last = lines.front().cols() - 1;
  for (Eigen::Index i = 0; i < count; ++i) kept.push_back((2 * i * last + count - 1) / (2 * (count - 1)));
  std::vector<Points> fewer;
  for (const Points& line : lines) fewer.push_back(line(Eigen::all, kept));
  return fewer;
}

/// As many points or fewer, each of which follows any of the coordinates, all the same one, or none: those with the
/// smallest errors of lengths and arms together. In a motion in which coordinates go together, points that follow the
/// wrong one have the right lengths and wrong arms.
static std::vector<FiberPoint> best_points(Skeleton& skeleton, const Path* own, const KnownFibers& known,
                                           const std::vector<FollowedCoordinate>& followed) {
  std::vector<std::vector<FollowedCoordinate>> choices = {followed, {}};
  for (const FollowedCoordinate& each : followed) choices.push_back({each});
  std::vector<FiberPoint> best;
  Real least = std::numeric_limits<Real>::infinity();
  const Eigen::Index most = known.lines.front().cols();
  for (Eigen::Index count = most; count >= 2; count = count > 2 ? std::max<Eigen::Index>(2, count * 2 / 3) : 1) {
    const std::vector<Points> lines = fewer_points(known.lines, count);
    for (const auto& choice : choices) {
      std::vector<FiberPoint> points = fit_points(lines, known.poses, choice);
      for (FiberPoint& point : points) point.body = known.bodies[static_cast<std::size_t>(point.body)];
      const PathErrors errors = point_errors(skeleton, path_of(points), own, known);
      const Real cost = std::hypot(errors.length_root_mean_square, errors.arm_root_mean_square);
      if (!(cost < 0.99 * least)) continue;
      least = cost;
      best = std::move(points);
    }
  }
  return best;
}

std::string point_errors_text(const PathErrors& errors, bool beside_model) {
  return fmt::format(
      "lengths {:.3f} mm root mean square, {:.3f} at most; arms {:.3f} mm root mean square, {:.3f} at most{}",
      1000 * errors.length_root_mean_square, 1000 * errors.length_largest, 1000 * errors.arm_root_mean_square,
      1000 * errors.arm_largest, beside_model ? " from the model's own" : "");
}

/// Whether an end goes with its body; it may glide on it where the model's own does.
static bool holds_end(const FiberPoint& end, const PathPoint* own) {
  return (own && own->moving ? end.left : end.moves) <= 0.005;
}

std::vector<FiberPoint> points_of(Skeleton& skeleton, const KnownFibers& known, const Muscle* own, std::string& why) {
  why = "has no fibers";
  if (known.lines.size() < 4) return {};
  std::vector<FiberPoint> points = best_points(skeleton, own ? &own->path : nullptr, known,
                                               followed_coordinates(skeleton.model(), own, known.samples.coordinates));
  const bool held = holds_end(points.front(), own ? &own->path.points.front() : nullptr) &&
                    holds_end(points.back(), own ? &own->path.points.back() : nullptr);
  why = "its ends move with no body of the model";
  return held ? points : std::vector<FiberPoint>{};
}

Muscle muscle_along(Skeleton& skeleton, const std::vector<FiberPoint>& points, const std::string& name,
                    const Muscle* own, const Eigen::VectorXd& capture) {
  Muscle muscle = own ? *own : Muscle{};
  muscle.name = name;
  muscle.path = path_of(points);
  if (!own) return muscle;
  skeleton.place(capture);
  const Real more =
      measure_path(skeleton, muscle.path, capture).length - measure_path(skeleton, own->path, capture).length;
  muscle.tendon_slack_length = std::max(muscle.tendon_slack_length + more, 0.0);
  return muscle;
}

}  // namespace gracilis::opensim
