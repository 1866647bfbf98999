#include <gracilis/transfer/wrap_muscles.hpp>

#include <gracilis/anatomy/joints/joint_twists.hpp>
#include <gracilis/opensim/export/muscle_points.hpp>
#include <gracilis/opensim/kinematics/skeleton.hpp>
#include <gracilis/opensim/reader/crossed_coordinates.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace gracilis {

namespace {

using opensim::KnownFibers;
using opensim::LengthSamples;

/// A muscle in those poses from one to another in which it has a length, and where these put the model's bodies.
KnownFibers known_fibers(const LengthSamples& samples, const opensim::MuscleLengths& muscle,
                         const std::vector<SharedBody>& bodies, Eigen::Index from, Eigen::Index to) {
  KnownFibers known;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = from; row < to; ++row) {
    const auto pose = static_cast<std::size_t>(row);
    if (!std::isfinite(muscle.lengths[row]) || muscle.fibers[pose].cols() == 0) continue;
    rows.push_back(row);
    known.lines.push_back(muscle.fibers[pose]);
    std::vector<RigidTransform>& poses = known.poses.emplace_back();
    for (const SharedBody& body : bodies)
      poses.push_back(samples.scene_poses[pose][static_cast<std::size_t>(body.of_scene)] * body.frame);
  }
  for (const SharedBody& body : bodies) known.bodies.push_back(body.of_model);
  known.samples.coordinates = samples.coordinates(rows, Eigen::all);
  known.samples.muscles = {{muscle.name, muscle.lengths(rows), muscle.arms(rows, Eigen::all)}};
  return known;
}

/// The bodies that a muscle is attached to; of ends on muscles those of the muscles below.
std::set<Index> attached_bodies(const Scene& scene, const Muscle& muscle) {
  std::set<Index> bodies;
  for (const Attachment& attachment : muscle.attachments) {
    const auto carried = std::find_if(scene.muscle_bodies.begin(), scene.muscle_bodies.end(),
                                      [&](const MuscleBody& each) { return each.body == attachment.body; });
    if (carried == scene.muscle_bodies.end())
      bodies.insert(attachment.body);
    else
      bodies.merge(attached_bodies(scene, scene.muscles[static_cast<std::size_t>(carried->muscle)]));
  }
  return bodies;
}

/// The scene's bodies that path points of a model's muscle may lie on: those that the scene's muscle of this name is
/// attached to and those that the model has between its own and these ends. None without such a muscle.
std::set<Index> bodies_of(const opensim::Model& model, const Scene& scene, const opensim::Muscle& own) {
  const auto muscle = std::find_if(scene.muscles.begin(), scene.muscles.end(),
                                   [&](const Muscle& each) { return each.name == own.name; });
  if (muscle == scene.muscles.end()) return {};
  std::set<Index> bodies = attached_bodies(scene, *muscle);
  std::vector<Index> ends;
  for (const Index body : bodies)
    if (const Index end = opensim::index_of(model.bodies, scene.bodies[static_cast<std::size_t>(body)]); end >= 0)
      ends.push_back(end);
  for (const Index between : opensim::bodies_between(model, own.path, ends)) {
    const std::string& name = model.bodies[static_cast<std::size_t>(between)].name;
    if (const auto found = std::find(scene.bodies.begin(), scene.bodies.end(), name); found != scene.bodies.end())
      bodies.insert(static_cast<Index>(found - scene.bodies.begin()));
  }
  return bodies;
}

}  // namespace

std::set<Index> bodies_to_share(const opensim::Model& model, const Scene& scene) {
  std::set<Index> wanted;
  for (const opensim::Muscle& own : model.muscles) wanted.merge(bodies_of(model, scene, own));
  return wanted;
}

std::string to_string(const WrappedMuscle& muscle) {
  return fmt::format("{}: {} points; {} {} poses: {}", muscle.name, muscle.points, muscle.poses,
                     muscle.held_out ? "held-out" : "fitted", opensim::point_errors_text(muscle.errors, false));
}

WrappedMuscles wrap_muscles(const opensim::Model& model, const Scene& scene, const std::vector<SharedBody>& shared,
                            const LengthSamples& samples) {
  WrappedMuscles wrapped;
  opensim::Skeleton skeleton(model);
  const Eigen::Index poses = samples.coordinates.rows();
  const auto fitted = poses - static_cast<Eigen::Index>(held_out_share * static_cast<Real>(poses));
  for (const opensim::MuscleLengths& each : samples.muscles) {
    const auto leave_out = [&](const std::string& why) { wrapped.left_out.push_back(each.name + ": " + why); };
    const Index index = opensim::index_of(model.muscles, each.name);
    if (index < 0) {
      leave_out("the model has no muscle of this name");
      continue;
    }
    const opensim::Muscle& own = model.muscles[static_cast<std::size_t>(index)];
    if (own.path.points.empty()) {
      leave_out("its path is a function");
      continue;
    }
    const std::set<Index> own_bodies = bodies_of(model, scene, own);
    std::vector<SharedBody> bodies;
    for (const SharedBody& body : shared)
      if (own_bodies.count(body.of_scene) > 0) bodies.push_back(body);
    std::string why = "none of its bodies is the model's, too";
    const KnownFibers known = known_fibers(samples, each, bodies, 0, fitted);
    const KnownFibers held_out = known_fibers(samples, each, bodies, fitted, poses);
    const std::vector<opensim::FiberPoint> points =
        bodies.empty() ? std::vector<opensim::FiberPoint>{} : points_of(skeleton, known, &own, why);
    if (points.empty()) {
      leave_out(why);
      continue;
    }
    const opensim::Muscle& muscle =
        wrapped.muscles.emplace_back(muscle_along(skeleton, points, each.name, &own, samples.coordinates.row(0)));
    const bool has_held_out = !held_out.lines.empty();
    const opensim::PathErrors errors = point_errors(skeleton, muscle.path, &own.path, has_held_out ? held_out : known);
    const std::size_t compared = has_held_out ? held_out.lines.size() : known.lines.size();
    wrapped.told.push_back(
        {each.name, static_cast<Index>(muscle.path.points.size()), static_cast<Index>(compared), has_held_out, errors});
  }
  return wrapped;
}

/// Whether the joint moves some, not all, of the bodies of a muscle.
static bool is_crossed(const Scene& scene, const Joint& joint) {
  return std::any_of(scene.muscles.begin(), scene.muscles.end(), [&](const Muscle& muscle) {
    const std::set<Index> bodies = attached_bodies(scene, muscle);
    const auto moved = std::count_if(bodies.begin(), bodies.end(), [&](Index b) { return hangs_on(scene, b, joint); });
    return moved > 0 && moved < static_cast<std::ptrdiff_t>(bodies.size());
  });
}

opensim::CoordinateBox shared_ranges(const opensim::Model& model, const Scene& scene) {
  std::vector<Real> least, most;
  opensim::CoordinateBox box;
  for (const Joint& joint : scene.joints) {
    if (!is_crossed(scene, joint)) continue;
    for (const JointAxis& axis : joint.axes) {
      const Index index = opensim::index_of(model.coordinates, axis.coordinate);
      if (index < 0 || opensim::is_dependent(model, index)) continue;
      const opensim::Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(index)];
      const Real from = std::max(axis.range_min, coordinate.range_min);
      const Real to = std::min(axis.range_max, coordinate.range_max);
      if (!(from < to)) continue;
      box.coordinates.push_back(index), least.push_back(from), most.push_back(to);
    }
  }
  const auto count = static_cast<Eigen::Index>(least.size());
  box.least = Eigen::Map<const Eigen::VectorXd>(least.data(), count);
  box.most = Eigen::Map<const Eigen::VectorXd>(most.data(), count);
  return box;
}

}  // namespace gracilis
