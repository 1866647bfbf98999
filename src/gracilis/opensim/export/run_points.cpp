#include <gracilis/opensim/export/run_points.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/opensim/export/fiber_points.hpp>
#include <gracilis/opensim/export/muscle_text.hpp>
#include <gracilis/opensim/export/path_samples.hpp>
#include <gracilis/opensim/export/run_lengths.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>
#include <gracilis/opensim/reader/crossed_coordinates.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis::opensim {

namespace {

/// What points of one muscle are fitted to: poses in which its fibers are known.
struct KnownFibers {
  LengthSamples samples;  ///< of this muscle alone
  std::vector<Points> lines;
  std::vector<std::vector<RigidTransform>> poses;
};

}  // namespace

/// The muscle in the poses in which it has a length: those of the samples where they hold fibers, else the run's
/// frames.
static KnownFibers known_fibers(const RecordedRun& run, const LengthSamples& samples, const MuscleLengths& muscle,
                                const std::vector<std::vector<RigidTransform>>& poses, Index count) {
  KnownFibers known;
  std::vector<Eigen::Index> rows;
  for (std::size_t pose = 0; pose < poses.size(); ++pose) {
    const auto row = static_cast<Eigen::Index>(pose);
    if (!std::isfinite(muscle.lengths[row])) continue;
    Points line = muscle.fibers.empty() ? mean_fiber(recorded_fibers(run, muscle.name, static_cast<int>(pose)), count)
                                        : muscle.fibers[pose];
    if (line.cols() == 0) return {};
    rows.push_back(row);
    known.lines.push_back(std::move(line));
    known.poses.push_back(poses[pose]);
  }
  known.samples.coordinates = samples.coordinates(rows, Eigen::all);
  known.samples.muscles = {{muscle.name, muscle.lengths(rows),
                            muscle.arms.cols() > 0 ? Eigen::MatrixXd(muscle.arms(rows, Eigen::all))
                                                   : Eigen::MatrixXd(static_cast<Eigen::Index>(rows.size()), 0)}};
  return known;
}

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

/// How far a path's lengths are from those of the fibers, and its arms from the run's or else from those of `own`; of
/// angles.
static PathErrors errors_of(Skeleton& skeleton, const Path& path, const Path* own, const LengthSamples& run,
                            const MuscleLengths& muscle, const std::vector<Points>& fibers) {
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

/// As many points or fewer, which follow all of the coordinates, one of them or none: those with the smallest errors of
/// lengths and arms together. In a motion in which coordinates go together, points that follow the wrong one have the
/// right lengths and wrong arms.
static std::vector<FiberPoint> best_points(Skeleton& skeleton, const Path* own, const LengthSamples& run,
                                           const MuscleLengths& muscle, const std::vector<Points>& fibers,
                                           const std::vector<std::vector<RigidTransform>>& poses,
                                           const std::vector<FollowedCoordinate>& followed) {
  std::vector<std::vector<FollowedCoordinate>> choices = {followed, {}};
  for (const FollowedCoordinate& each : followed) choices.push_back({each});
  std::vector<FiberPoint> best;
  Real least = std::numeric_limits<Real>::infinity();
  const Eigen::Index most = fibers.front().cols();
  for (Eigen::Index count = most; count >= 2; count = count > 2 ? std::max<Eigen::Index>(2, count * 2 / 3) : 1) {
    const std::vector<Points> lines = fewer_points(fibers, count);
    for (const auto& choice : choices) {
      std::vector<FiberPoint> points = fit_points(lines, poses, choice);
      const PathErrors errors = errors_of(skeleton, path_of(points), own, run, muscle, fibers);
      const Real cost = std::hypot(errors.length_root_mean_square, errors.arm_root_mean_square);
      if (!(cost < 0.99 * least)) continue;
      least = cost;
      best = std::move(points);
    }
  }
  return best;
}

static std::string point_errors_text(const PathErrors& errors, bool beside_model) {
  return fmt::format(
      "lengths {:.3f} mm root mean square, {:.3f} at most; arms {:.3f} mm root mean square, {:.3f} at most{}",
      1000 * errors.length_root_mean_square, 1000 * errors.length_largest, 1000 * errors.arm_root_mean_square,
      1000 * errors.arm_largest, beside_model ? " from the model's own" : "");
}

/// Whether an end goes with its body; it may glide on it where the model's own does.
static bool holds_end(const FiberPoint& end, const PathPoint* own) {
  return (own && own->moving ? end.left : end.moves) <= 0.005;
}

/// Points of one muscle; why it has none.
static std::vector<FiberPoint> points_of(Skeleton& skeleton, const KnownFibers& known, const Muscle* own,
                                         std::string& why) {
  why = "has no fibers";
  if (known.lines.size() < 4) return {};
  std::vector<FiberPoint> points =
      best_points(skeleton, own ? &own->path : nullptr, known.samples, known.samples.muscles[0], known.lines,
                  known.poses, followed_coordinates(skeleton.model(), own, known.samples.coordinates));
  const bool held = holds_end(points.front(), own ? &own->path.points.front() : nullptr) &&
                    holds_end(points.back(), own ? &own->path.points.back() : nullptr);
  why = "its ends move with no body of the model";
  return held ? points : std::vector<FiberPoint>{};
}

/// The model's muscle, or a new one, along these points. Fibers are no longer than they were in the capture pose: what
/// the way is longer there is tendon.
static Muscle muscle_along(Skeleton& skeleton, const std::vector<FiberPoint>& points, const std::string& name,
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

PointExport export_points(const std::filesystem::path& folder, const Model& model, const LengthSamples& samples,
                          Index count, const std::filesystem::path& out) {
  const RecordedRun run = open_recorded_run(folder);
  const Eigen::Index pose_count = samples.spread ? samples.coordinates.rows() : run.frame_count;
  if (samples.coordinates.rows() < pose_count)
    throw InputError({folder.string(), "", "has fewer rows of fiber lengths than frames", "run the scene again"});
  Skeleton skeleton(model);
  std::vector<std::vector<RigidTransform>> poses;
  for (Eigen::Index row = 0; row < pose_count; ++row) {
    skeleton.place(samples.coordinates.row(row));
    poses.push_back(skeleton.poses());
  }
  PointExport result;
  std::string text;
  std::vector<KnownFibers> written;
  for (const MuscleLengths& each : samples.muscles) {
    const Index index = index_of(model.muscles, each.name);
    const Muscle* own = index < 0 ? nullptr : &model.muscles[static_cast<std::size_t>(index)];
    if (own && own->path.points.empty()) {
      result.left_out.push_back(fmt::format("{}: its path is a function", each.name));
      continue;
    }
    std::vector<FiberPoint> points;
    std::string why = "it follows the model's line";
    KnownFibers known;
    if (!(own && samples.follow_lines)) {
      known = known_fibers(run, samples, each, poses, count);
      points = points_of(skeleton, known, own, why);
    }
    if (points.empty()) {
      result.left_out.push_back(fmt::format("{}: {}", each.name, why));
      if (own) text += muscle_text(model, *own);
      continue;
    }
    text += muscle_text(model, muscle_along(skeleton, points, each.name, own, samples.coordinates.row(0)));
    written.push_back(std::move(known));
  }
  if (text.empty()) throw InputError({folder.string(), "", "has no fibers", "run the scene with fibers"});
  write_text_atomically(out, fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument "
                                         "Version=\"40000\">\n  <ForceSet name=\"{}\">\n    <objects>\n{}    "
                                         "</objects>\n  </ForceSet>\n</OpenSimDocument>\n",
                                         folder.filename().string(), text));
  Model read = model;
  read_force_set(out, true, read);
  Skeleton read_skeleton(read);
  for (const KnownFibers& known : written) {
    const MuscleLengths& muscle = known.samples.muscles[0];
    const Index index = index_of(model.muscles, muscle.name);
    const Path* own = index < 0 ? nullptr : &model.muscles[static_cast<std::size_t>(index)].path;
    const Path& path = read.muscles[static_cast<std::size_t>(index_of(read.muscles, muscle.name))].path;
    result.lines.push_back(
        fmt::format("{}: {} points; {}", muscle.name, path.points.size(),
                    point_errors_text(errors_of(read_skeleton, path, own, known.samples, muscle, known.lines),
                                      muscle.arms.cols() == 0)));
  }
  return result;
}

}  // namespace gracilis::opensim
