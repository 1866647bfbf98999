#include <gracilis/opensim/static_optimization/static_optimization.hpp>

#include <gracilis/opensim/kinematics/quintic_spline.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>
#include <gracilis/opensim/static_optimization/bounded_qp.hpp>
#include <gracilis/opensim/static_optimization/passive_forces.hpp>
#include <gracilis/opensim/static_optimization/rigid_tendon.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

namespace {

/// A motion with its speeds and accelerations.
struct Kinematics {
  const CoordinateMotion& motion;
  Eigen::MatrixXd speeds, accelerations;

  explicit Kinematics(const CoordinateMotion& the_motion) : motion(the_motion) {
    speeds = quintic_spline(motion.times, motion.values).slopes;
    accelerations = quintic_spline(motion.times, speeds).slopes;
  }
};

/// Forces of all muscles and actuators at full activation, and what they do to each coordinate.
struct Strengths {
  Eigen::VectorXd forces;
  Eigen::MatrixXd effects;  ///< coordinates × forces
};

}  // namespace

/// Generalized forces that the motion needs at a row; places the skeleton.
static Eigen::VectorXd needed_forces(Skeleton& skeleton, const Kinematics& kinematics, const ExternalLoads& loads,
                                     std::size_t row) {
  const auto i = static_cast<Eigen::Index>(row);
  const Eigen::VectorXd coordinates = kinematics.motion.values.row(i);
  skeleton.place(coordinates);
  BodyForces applied = BodyForces::Zero(6, static_cast<Eigen::Index>(skeleton.poses().size()));
  add_loads(loads, kinematics.motion.times[row], skeleton.poses(), applied);
  const Eigen::VectorXd passive = passive_forces(skeleton, coordinates, kinematics.speeds.row(i));
  return onto_independent(
      skeleton.model(), coordinates,
      skeleton.inverse_dynamics(kinematics.speeds.row(i), kinematics.accelerations.row(i), applied) - passive);
}

/// What an actuator does to each coordinate, per unit of force.
static Eigen::VectorXd effect_of(const Skeleton& skeleton, const Actuator& actuator,
                                 const Eigen::VectorXd& coordinates) {
  Eigen::VectorXd effect = Eigen::VectorXd::Zero(coordinates.size());
  if (actuator.kind == Actuator::Kind::coordinate) {
    effect[actuator.coordinate] = 1;
  } else {
    const auto& poses = skeleton.poses();
    const RigidTransform& pose = poses[static_cast<std::size_t>(actuator.body)];
    const Vec3 direction = actuator.direction_is_global ? actuator.direction : Vec3(pose.linear() * actuator.direction);
    BodyForces forces = BodyForces::Zero(6, static_cast<Eigen::Index>(poses.size()));
    if (actuator.kind == Actuator::Kind::point) {
      add_force(forces, actuator.body, pose, actuator.point_is_global ? actuator.point : pose * actuator.point,
                direction);
    } else {
      forces.col(actuator.body).head<3>() += direction;
      forces.col(actuator.other_body).head<3>() -= direction;
    }
    effect = skeleton.generalized_forces(forces);
  }
  return onto_independent(skeleton.model(), coordinates, effect);
}

/// Muscles and actuators that apply force, muscles first.
static std::pair<std::vector<const Muscle*>, std::vector<const Actuator*>> active_forces(const Model& model) {
  std::vector<const Muscle*> muscles;
  std::vector<const Actuator*> actuators;
  for (const Muscle& muscle : model.muscles)
    if (muscle.applies_force) muscles.push_back(&muscle);
  for (const Actuator& actuator : model.actuators)
    if (actuator.applies_force) actuators.push_back(&actuator);
  return {muscles, actuators};
}

static Strengths strengths(const Skeleton& skeleton, const Eigen::VectorXd& coordinates, const Eigen::VectorXd& speeds,
                           bool physiology) {
  const auto [muscles, actuators] = active_forces(skeleton.model());
  const auto count = static_cast<Eigen::Index>(muscles.size() + actuators.size());
  Strengths result{Eigen::VectorXd(count), Eigen::MatrixXd(coordinates.size(), count)};
  Eigen::Index column = 0;
  for (const Muscle* muscle : muscles) {
    const PathMeasure path = measure_path(skeleton, muscle->path, coordinates);
    const Real force = physiology ? rigid_tendon_force(*muscle, path.length, -path.moment_arms.dot(speeds))
                                  : muscle->max_isometric_force;
    result.forces[column] = force;
    result.effects.col(column++) = force * path.moment_arms;
  }
  for (const Actuator* actuator : actuators) {
    result.forces[column] = actuator->optimal_force;
    result.effects.col(column++) = actuator->optimal_force * effect_of(skeleton, *actuator, coordinates);
  }
  return result;
}

/// Coordinates whose forces must be found: neither locked nor dependent.
static std::vector<Eigen::Index> asked_coordinates(const Model& model) {
  std::vector<Eigen::Index> asked;
  for (std::size_t i = 0; i < model.coordinates.size(); ++i) {
    const auto index = static_cast<Index>(i);
    const bool dependent = std::any_of(model.couplers.begin(), model.couplers.end(),
                                       [&](const Coupler& coupler) { return coupler.dependent == index; });
    if (!dependent && !model.coordinates[i].locked) asked.push_back(index);
  }
  return asked;
}

static InfeasibleInstant missing_forces(const Model& model, const std::vector<Eigen::Index>& asked, Real time,
                                        const Eigen::VectorXd& missing) {
  InfeasibleInstant instant{time, {}};
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const Real value = missing[static_cast<Eigen::Index>(i)];
    if (std::abs(value) > 1e-4 * missing.lpNorm<Eigen::Infinity>())
      instant.missing.emplace_back(model.coordinates[static_cast<std::size_t>(asked[i])].name, value);
  }
  std::sort(instant.missing.begin(), instant.missing.end(),
            [](const auto& a, const auto& b) { return std::abs(a.second) > std::abs(b.second); });
  return instant;
}

/// A table for these rows with a column per muscle and actuator.
static Table empty_result(const Model& model, const CoordinateMotion& motion, const std::vector<std::size_t>& rows) {
  Table table;
  table.name = "Static Optimization";
  for (const std::size_t row : rows) table.times.push_back(motion.times[row]);
  const auto [muscles, actuators] = active_forces(model);
  for (const Muscle* muscle : muscles) table.columns.push_back(muscle->name);
  for (const Actuator* actuator : actuators) table.columns.push_back(actuator->name);
  table.values.setZero(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(table.columns.size()));
  return table;
}

static BoundedQp limits(const Model& model) {
  const auto [muscles, actuators] = active_forces(model);
  BoundedQp problem;
  problem.lower.resize(static_cast<Eigen::Index>(muscles.size() + actuators.size()));
  problem.upper.resizeLike(problem.lower);
  Eigen::Index column = 0;
  const auto add = [&](Real lower, Real upper) {
    problem.lower[column] = lower;
    problem.upper[column++] = upper;
  };
  for (const Muscle* muscle : muscles) add(muscle->min_control, muscle->max_control);
  for (const Actuator* actuator : actuators) add(actuator->min_control, actuator->max_control);
  return problem;
}

StaticOptimizationResult static_optimization(const Model& model, const CoordinateMotion& motion,
                                             const ExternalLoads& loads, const std::vector<std::size_t>& rows,
                                             const StaticOptimizationSettings& settings,
                                             const std::function<void(std::size_t)>& progress) {
  const Kinematics kinematics(motion);
  const std::vector<Eigen::Index> asked = asked_coordinates(model);
  BoundedQp problem = limits(model);
  StaticOptimizationResult result{empty_result(model, motion, rows), empty_result(model, motion, rows), {}};
  Skeleton skeleton(model);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(rows[i]);
    const Eigen::VectorXd needed = needed_forces(skeleton, kinematics, loads, rows[i]);
    const Strengths strong =
        strengths(skeleton, motion.values.row(row), kinematics.speeds.row(row), settings.use_muscle_physiology);
    problem.a = strong.effects(asked, Eigen::all);
    problem.b = needed(asked);
    const BoundedQpSolution solution = minimize_powers(problem, settings.exponent);
    const auto place = static_cast<Eigen::Index>(i);
    result.activations.values.row(place) = solution.x;
    result.forces.values.row(place) = solution.x.cwiseProduct(strong.forces);
    if (!solution.feasible)
      result.infeasible.push_back(missing_forces(model, asked, motion.times[rows[i]], solution.missing));
    if (progress) progress(i + 1);
  }
  return result;
}

Table inverse_dynamics(const Model& model, const CoordinateMotion& motion, const ExternalLoads& loads,
                       const std::vector<std::size_t>& rows) {
  const Kinematics kinematics(motion);
  Table table;
  table.name = "Inverse Dynamics Generalized Forces";
  for (const Coordinate& coordinate : model.coordinates)
    table.columns.push_back(coordinate.name + (coordinate.rotation ? "_moment" : "_force"));
  table.values.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(table.columns.size()));
  Skeleton skeleton(model);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    table.times.push_back(motion.times[rows[i]]);
    table.values.row(static_cast<Eigen::Index>(i)) = needed_forces(skeleton, kinematics, loads, rows[i]);
  }
  return table;
}

}  // namespace gracilis::opensim
