#include <gracilis/opensim/export/run_points.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/opensim/kinematics/coordinate_motion.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>
#include <gracilis/opensim/reader/crossed_coordinates.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis::opensim {

using Poses = std::vector<RigidTransform>;

/// The point's places in a body, 3 × frames.
static Points places_in(const std::vector<Points>& fibers, Eigen::Index point, const std::vector<Poses>& poses,
                        std::size_t body) {
  Points places(3, static_cast<Eigen::Index>(fibers.size()));
  for (std::size_t f = 0; f < fibers.size(); ++f)
    places.col(static_cast<Eigen::Index>(f)) = poses[f][body].inverse() * fibers[f].col(point);
  return places;
}

static Real movement(const Points& places) {
  const Points off = places.colwise() - places.rowwise().mean();
  return std::sqrt(off.squaredNorm() / static_cast<Real>(places.cols()));
}

/// The point's places by the moving coordinate: means over up to 15 equal parts of its range, unless that explains too
/// little of the movement.
static void follow(const std::vector<Real>& moving, const Points& places, FiberPoint& point) {
  struct Part {
    Real value = 0;
    Vec3 place = Vec3::Zero();
    int count = 0;
  };
  const auto [least, most] = std::minmax_element(moving.begin(), moving.end());
  std::vector<Part> parts(std::min<std::size_t>(15, moving.size()));
  for (std::size_t f = 0; f < moving.size(); ++f) {
    const Real share = (moving[f] - *least) / std::max(*most - *least, 1e-12);
    Part& part = parts[std::min(static_cast<std::size_t>(share * static_cast<Real>(parts.size())), parts.size() - 1)];
    part.value += moving[f];
    part.place += places.col(static_cast<Eigen::Index>(f));
    ++part.count;
  }
  std::erase_if(parts, [](const Part& part) { return part.count == 0; });
  if (parts.size() < 2) return;
  FiberPoint moved = point;
  moved.places.resize(3, static_cast<Eigen::Index>(parts.size()));
  for (std::size_t k = 0; k < parts.size(); ++k) {
    moved.knots.push_back(parts[k].value / parts[k].count);
    moved.places.col(static_cast<Eigen::Index>(k)) = parts[k].place / parts[k].count;
  }
  Real left = 0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::VectorXd y = moved.places.row(i);
    const Function spline = simm_spline(moved.knots, {y.begin(), y.end()});
    for (std::size_t f = 0; f < moving.size(); ++f)
      left += std::pow(value(spline, {moving[f]}) - places(i, static_cast<Eigen::Index>(f)), 2);
  }
  moved.left = std::sqrt(left / static_cast<Real>(moving.size()));
  if (moved.left <= 0.7 * point.moves) point = moved;
}

std::vector<FiberPoint> fit_points(const std::vector<Points>& fibers, const std::vector<Poses>& poses,
                                   const std::vector<Real>& moving) {
  std::vector<FiberPoint> result;
  const Eigen::Index count = fibers.front().cols();
  for (Eigen::Index p = 0; p < count; ++p) {
    FiberPoint point;
    Points places = places_in(fibers, p, poses, 0);
    point.moves = movement(places);
    // A body that does not move beside the ground is the better home.
    for (std::size_t body = 1; body < poses.front().size(); ++body) {
      const Points here = places_in(fibers, p, poses, body);
      const Real moves = movement(here);
      if (moves > point.moves - (point.body == 0 ? -1e-9 : 1e-9)) continue;
      point.body = static_cast<Index>(body);
      point.moves = moves;
      places = here;
    }
    point.location = places.rowwise().mean();
    point.left = point.moves;
    const bool end = p == 0 || p + 1 == count;
    if (!moving.empty() && point.moves > (end ? 5e-4 : 1e-5)) follow(moving, places, point);
    result.push_back(std::move(point));
  }
  return result;
}

Path path_of(const std::vector<FiberPoint>& points, Index coordinate) {
  Path path;
  for (const FiberPoint& fitted : points) {
    PathPoint point;
    point.name = fmt::format("p{}", path.points.size() + 1);
    point.body = fitted.body;
    point.location = fitted.location;
    point.moving = fitted.knots.size() > 1;
    for (std::size_t i = 0; i < 3 && point.moving; ++i) {
      const Eigen::VectorXd y = fitted.places.row(static_cast<Eigen::Index>(i));
      point.moves_with[i] = coordinate;
      point.moves_to[i] = simm_spline(fitted.knots, {y.begin(), y.end()});
    }
    path.points.push_back(std::move(point));
  }
  return path;
}

static std::string moving_text(const Model& model, const PathPoint& point) {
  std::string text;
  const char* names[3] = {"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    const Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(point.moves_with[i])];
    const std::string& joint = model.joints[static_cast<std::size_t>(coordinate.joint)].name;
    std::vector<Real> y;
    for (const Real knot : point.moves_to[i].knots) y.push_back(value(point.moves_to[i], {knot}));
    text += fmt::format(
        "            <socket_{0}_coordinate>/jointset/{1}/{2}</socket_{0}_coordinate>\n"
        "            <{0}_location><SimmSpline><x>{3}</x><y>{4}</y></SimmSpline></{0}_location>\n",
        names[i], joint, coordinate.name, fmt::join(point.moves_to[i].knots, " "), fmt::join(y, " "));
  }
  return text;
}

static std::string point_text(const Model& model, const PathPoint& point) {
  const std::string& body = model.bodies[static_cast<std::size_t>(point.body)].name;
  const std::string frame = point.body == 0 ? "/ground" : "/bodyset/" + body;
  const char* kind = point.moving ? "MovingPathPoint" : "PathPoint";
  std::string text =
      fmt::format("          <{} name=\"{}\">\n            <socket_parent_frame>{}</socket_parent_frame>\n", kind,
                  point.name, frame);
  text += point.moving ? moving_text(model, point)
                       : fmt::format("            <location>{} {} {}</location>\n", point.location.x(),
                                     point.location.y(), point.location.z());
  return text + fmt::format("          </{}>\n", kind);
}

std::string muscle_text(const Model& model, const Muscle& muscle) {
  const std::string type = muscle.type.empty() ? "Thelen2003Muscle" : muscle.type;
  std::string text = fmt::format(
      "      <{} name=\"{}\">\n        <max_isometric_force>{}</max_isometric_force>\n"
      "        <optimal_fiber_length>{}</optimal_fiber_length>\n"
      "        <tendon_slack_length>{}</tendon_slack_length>\n"
      "        <pennation_angle_at_optimal>{}</pennation_angle_at_optimal>\n        <GeometryPath name=\"path\">\n"
      "          <PathPointSet><objects>\n",
      type, muscle.name, muscle.max_isometric_force, muscle.optimal_fiber_length, muscle.tendon_slack_length,
      muscle.pennation_angle_at_optimal);
  for (const PathPoint& point : muscle.path.points) text += point_text(model, point);
  return text + fmt::format("          </objects></PathPointSet>\n        </GeometryPath>\n      </{}>\n", type);
}

/// The mean of a muscle's fibers in a frame, `count` points; none where the run has none of it.
static Points mean_fiber(const RecordedRun& run, const std::string& muscle, int frame, Index count) {
  const Polylines fibers = recorded_fibers(run, muscle, frame);
  if (fibers.count() == 0) return Points(3, 0);
  Points mean = Points::Zero(3, count);
  for (Index i = 0; i < fibers.count(); ++i) mean += resampled(fibers.line(i), count - 1);
  return mean / fibers.count();
}

/// The coordinate that changes most in a motion, or -1.
static Index most_moving(const CoordinateMotion& motion) {
  const Eigen::VectorXd range = motion.values.colwise().maxCoeff() - motion.values.colwise().minCoeff();
  Eigen::Index found = -1;
  return range.size() > 0 && range.maxCoeff(&found) > 1e-4 ? static_cast<Index>(found) : -1;
}

static std::vector<Real> values_of(const CoordinateMotion& motion, Index coordinate, std::size_t frames) {
  std::vector<Real> values;
  for (std::size_t f = 0; f < frames && coordinate >= 0; ++f)
    values.push_back(motion.values(static_cast<Eigen::Index>(f), coordinate));
  return values;
}

/// How far a path's lengths are from those of the fibers, m: root mean square and largest.
static std::pair<Real, Real> errors_of(const Model& model, const Path& path, const CoordinateMotion& motion,
                                       const std::vector<Points>& fibers) {
  Skeleton skeleton(model);
  Real sum = 0, largest = 0;
  for (std::size_t f = 0; f < fibers.size(); ++f) {
    const Eigen::VectorXd coordinates = motion.values.row(static_cast<Eigen::Index>(f));
    skeleton.place(coordinates);
    const Real error = measure_path(skeleton, path, coordinates).length - polyline_length(fibers[f]);
    sum += error * error;
    largest = std::max(largest, std::abs(error));
  }
  return {std::sqrt(sum / static_cast<Real>(fibers.size())), largest};
}

/// Points that move with that coordinate, of those that the muscle crosses and `otherwise`, that leaves least of their
/// movement.
static std::vector<FiberPoint> best_points(const Model& model, const Muscle* known, const CoordinateMotion& motion,
                                           const std::vector<Points>& lines, const std::vector<Poses>& poses,
                                           Index otherwise, Index& chosen) {
  std::vector<Index> candidates;
  if (known)
    for (const Index i : crossed_coordinates(model, known->path))
      if (motion.values.col(i).maxCoeff() - motion.values.col(i).minCoeff() > 1e-4) candidates.push_back(i);
  candidates.push_back(otherwise);
  std::vector<FiberPoint> best;
  Real least = std::numeric_limits<Real>::infinity();
  for (const Index candidate : candidates) {
    std::vector<FiberPoint> points = fit_points(lines, poses, values_of(motion, candidate, lines.size()));
    Real left = 0;
    for (const FiberPoint& point : points) left += point.left * point.left;
    if (!(left < least)) continue;
    least = left;
    best = std::move(points);
    chosen = candidate;
  }
  return best;
}

std::vector<std::string> export_points(const std::filesystem::path& folder, const Model& model, Index count,
                                       const std::filesystem::path& out) {
  const RecordedRun run = open_recorded_run(folder);
  const CoordinateMotion motion = coordinate_motion(model, read_table(folder / "fiber_lengths.sto"));
  if (static_cast<int>(motion.times.size()) < run.frame_count)
    throw InputError({folder.string(), "", "has fewer rows of fiber lengths than frames", "run the scene again"});
  Skeleton skeleton(model);
  std::vector<Poses> poses;
  for (int f = 0; f < run.frame_count; ++f) {
    skeleton.place(motion.values.row(f));
    poses.push_back(skeleton.poses());
  }
  const Index most = most_moving(motion);

  std::string text;
  std::vector<std::vector<Points>> fibers;
  std::vector<std::string> names;
  for (const std::string& name : run.muscles) {
    std::vector<Points> lines;
    for (int f = 0; f < run.frame_count; ++f) lines.push_back(mean_fiber(run, name, f, count));
    if (lines.front().cols() == 0) continue;
    const Index known = index_of(model.muscles, name);
    Index coordinate = -1;
    const std::vector<FiberPoint> points =
        best_points(model, known < 0 ? nullptr : &model.muscles[static_cast<std::size_t>(known)], motion, lines, poses,
                    most, coordinate);
    if (std::max(points.front().left, points.back().left) > 0.005)
      throw InputError({folder.string(), name, "has ends that move with no body of the model",
                        "name the model that the run's scene was made of"});
    Muscle muscle = known >= 0 ? model.muscles[static_cast<std::size_t>(known)] : Muscle{};
    muscle.name = name;
    muscle.path = path_of(points, coordinate);
    text += muscle_text(model, muscle);
    fibers.push_back(std::move(lines));
    names.push_back(name);
  }
  if (names.empty()) throw InputError({folder.string(), "", "has no fibers", "run the scene with fibers"});
  write_text_atomically(out, fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument "
                                         "Version=\"40000\">\n  <ForceSet name=\"{}\">\n    <objects>\n{}    "
                                         "</objects>\n  </ForceSet>\n</OpenSimDocument>\n",
                                         folder.filename().string(), text));
  Model read = model;
  read_force_set(out, true, read);
  std::vector<std::string> lines;
  for (std::size_t m = 0; m < names.size(); ++m) {
    const auto [root_mean_square, largest] = errors_of(read, read.muscles[m].path, motion, fibers[m]);
    lines.push_back(fmt::format("{}: {} points; {:.3f} mm root mean square, {:.3f} mm at most", names[m], count,
                                1000 * root_mean_square, 1000 * largest));
  }
  return lines;
}

}  // namespace gracilis::opensim
