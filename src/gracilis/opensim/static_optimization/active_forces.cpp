#include <gracilis/opensim/static_optimization/active_forces.hpp>

#include <gracilis/opensim/paths/muscle_path.hpp>
#include <gracilis/opensim/static_optimization/rigid_tendon.hpp>

#include <algorithm>

namespace gracilis::opensim {

ActiveForces::ActiveForces(const Model& model) {
  for (const Muscle& muscle : model.muscles)
    if (muscle.applies_force) muscles.push_back(&muscle);
  for (const Actuator& actuator : model.actuators)
    if (actuator.applies_force) actuators.push_back(&actuator);
}

std::vector<std::string> ActiveForces::names() const {
  std::vector<std::string> names;
  for (const Muscle* muscle : muscles) names.push_back(muscle->name);
  for (const Actuator* actuator : actuators) names.push_back(actuator->name);
  return names;
}

AppliedForces unit_effect(const Skeleton& skeleton, const Actuator& actuator) {
  AppliedForces effect(skeleton.model());
  if (actuator.kind == Actuator::Kind::coordinate) {
    effect.coordinates[actuator.coordinate] = 1;
    return effect;
  }
  const RigidTransform& pose = skeleton.poses()[static_cast<std::size_t>(actuator.body)];
  const Vec3 direction = actuator.direction_is_global ? actuator.direction : Vec3(pose.linear() * actuator.direction);
  if (actuator.kind == Actuator::Kind::point) {
    const Vec3 point = actuator.point_is_global ? actuator.point : pose * actuator.point;
    add_force(effect.bodies, actuator.body, pose, point, direction);
  } else {
    effect.bodies.col(actuator.body).head<3>() += direction;
    effect.bodies.col(actuator.other_body).head<3>() -= direction;
  }
  return effect;
}

InstantForces instant_forces(const Skeleton& skeleton, const ActiveForces& active, const Eigen::VectorXd& coordinates,
                             const Eigen::VectorXd& speeds) {
  InstantForces instant;
  const auto muscles = static_cast<Eigen::Index>(active.muscles.size());
  instant.lengths.resize(muscles);
  instant.speeds.resize(muscles);
  instant.effects.resize(coordinates.size(), active.count());
  Eigen::Index column = 0;
  for (const Muscle* muscle : active.muscles) {
    const PathMeasure path = measure_path(skeleton, muscle->path, coordinates);
    instant.lengths[column] = path.length;
    instant.speeds[column] = -path.moment_arms.dot(speeds);
    instant.effects.col(column++) = path.moment_arms;
  }
  for (const Actuator* actuator : active.actuators)
    instant.effects.col(column++) =
        onto_independent(skeleton.model(), coordinates, skeleton.generalized_forces(unit_effect(skeleton, *actuator)));
  return instant;
}

/// The force of fibers and tendon, and how it grows with activation (differences).
static void set_muscle(const Muscle& muscle, Real activation, Real length, Real speed, bool elastic,
                       Strengths& strengths, Eigen::Index i) {
  const Real step = 1e-4, low = std::max(activation - step, 0.0), high = activation + step;
  const auto state = [&](Real a) { return muscle_state(muscle, a, length, speed, elastic); };
  const MuscleState here = state(activation);
  strengths.forces[i] = here.force;
  strengths.fiber_lengths[i] = here.fiber_length;
  strengths.slopes[i] = (state(high).force - state(low).force) / (high - low);
}

Strengths strengths(const ActiveForces& active, const InstantForces& instant, const Eigen::VectorXd& activations,
                    MuscleForces kind, bool physiology) {
  Strengths result{Eigen::VectorXd(active.count()), Eigen::VectorXd(active.count()), {}};
  const bool fibers = physiology && kind != MuscleForces::opensim;
  if (fibers) result.fiber_lengths.resize(static_cast<Eigen::Index>(active.muscles.size()));
  const auto set_linear = [&](Eigen::Index i, Real largest) {
    result.slopes[i] = largest;
    result.forces[i] = activations[i] * largest;
  };
  Eigen::Index i = 0;
  for (const Muscle* muscle : active.muscles) {
    if (fibers)
      set_muscle(*muscle, activations[i], instant.lengths[i], instant.speeds[i], kind == MuscleForces::elastic, result,
                 i);
    else
      set_linear(i, physiology ? rigid_tendon_force(*muscle, instant.lengths[i], instant.speeds[i])
                               : muscle->max_isometric_force);
    ++i;
  }
  for (const Actuator* actuator : active.actuators) set_linear(i++, actuator->optimal_force);
  return result;
}

}  // namespace gracilis::opensim
