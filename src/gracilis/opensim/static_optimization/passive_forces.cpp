#include <gracilis/opensim/static_optimization/passive_forces.hpp>

#include <gracilis/opensim/paths/muscle_path.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

using Vec6 = Eigen::Matrix<Real, 6, 1>;

/// From 0 to 1, level at both ends up to the second derivative.
static Real smooth_step(Real x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10 - 15 * x + 6 * x * x);
}

static Real limit_force(const PassiveForce& limit, Real q, Real speed) {
  const Real width = std::max(limit.transition, 1e-12);
  const Real above = smooth_step((q - limit.upper_limit) / width), below = smooth_step((limit.lower_limit - q) / width);
  return -above * limit.upper_stiffness * (q - limit.upper_limit) +
         below * limit.lower_stiffness * (limit.lower_limit - q) - limit.damping * (above + below) * speed;
}

/// The tension times the arms: a path pulls to become shorter.
static Eigen::VectorXd path_force(const Skeleton& skeleton, const PassiveForce& force,
                                  const Eigen::VectorXd& coordinates, const Eigen::VectorXd& speeds) {
  const PathMeasure path = measure_path(skeleton, force.path, coordinates);
  if (path.length <= force.rest_length) return Eigen::VectorXd::Zero(coordinates.size());
  const Real speed = -path.moment_arms.dot(speeds);
  const Real tension = force.kind == PassiveForce::Kind::ligament
                           ? force.pcsa_force * value(force.curve, {path.length / force.rest_length})
                           : force.stiffness * (path.length - force.rest_length) * (1 + force.damping * speed);
  return tension * path.moment_arms;
}

static Eigen::VectorXd point_spring_force(const Skeleton& skeleton, const PassiveForce& force) {
  const auto& poses = skeleton.poses();
  const RigidTransform& pose = poses[static_cast<std::size_t>(force.body)];
  const RigidTransform& other = poses[static_cast<std::size_t>(force.other_body)];
  const Vec3 from = pose * force.frame.translation(), to = other * force.other_frame.translation(), along = to - from;
  BodyForces forces = BodyForces::Zero(6, static_cast<Eigen::Index>(poses.size()));
  if (const Real length = along.norm(); length > 0) {
    const Vec3 pull = force.stiffness * (length - force.rest_length) / length * along;
    add_force(forces, force.body, pose, from, pull);
    add_force(forces, force.other_body, other, to, -pull);
  }
  return skeleton.generalized_forces(forces);
}

/// Where the second frame lies in the first: rotations about x, then the new y, then the new z, and the translation.
static Vec6 bushing_place(const Skeleton& skeleton, const PassiveForce& force) {
  const auto& poses = skeleton.poses();
  const RigidTransform first = poses[static_cast<std::size_t>(force.body)] * force.frame;
  const RigidTransform second = poses[static_cast<std::size_t>(force.other_body)] * force.other_frame;
  const RigidTransform between = first.inverse() * second;
  const auto& r = between.linear();
  Vec6 place;
  place << std::atan2(-r(1, 2), r(2, 2)), std::asin(std::clamp(r(0, 2), -1.0, 1.0)), std::atan2(-r(0, 1), r(0, 0)),
      between.translation();
  return place;
}

/// The work of the bushing's forces with each coordinate, by how these change its place (central differences).
static Eigen::VectorXd bushing_force(Skeleton& skeleton, const PassiveForce& force, const Eigen::VectorXd& coordinates,
                                     const Eigen::VectorXd& speeds) {
  const Real step = 1e-5;  // rad or m
  Eigen::Matrix<Real, 6, Eigen::Dynamic> rates(6, coordinates.size());
  for (Eigen::Index i = 0; i < coordinates.size(); ++i) {
    Eigen::VectorXd moved = coordinates;
    moved[i] += step;
    skeleton.place(moved);
    const Vec6 after = bushing_place(skeleton, force);
    moved[i] -= 2 * step;
    skeleton.place(moved);
    rates.col(i) = (after - bushing_place(skeleton, force)) / (2 * step);
  }
  skeleton.place(coordinates);
  const Vec6 pull =
      -force.stiffnesses.cwiseProduct(bushing_place(skeleton, force)) - force.dampings.cwiseProduct(rates * speeds);
  return rates.transpose() * pull;
}

Eigen::VectorXd passive_forces(Skeleton& skeleton, const Eigen::VectorXd& coordinates, const Eigen::VectorXd& speeds) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(coordinates.size());
  for (const PassiveForce& force : skeleton.model().passive_forces) {
    if (!force.applies_force) continue;
    switch (force.kind) {
      case PassiveForce::Kind::limit:
        sum[force.coordinate] += limit_force(force, coordinates[force.coordinate], speeds[force.coordinate]);
        break;
      case PassiveForce::Kind::coordinate_spring:
        sum[force.coordinate] -= force.stiffness * (coordinates[force.coordinate] - force.rest_length) +
                                 force.damping * speeds[force.coordinate];
        break;
      case PassiveForce::Kind::path_spring:
      case PassiveForce::Kind::ligament:
        sum += path_force(skeleton, force, coordinates, speeds);
        break;
      case PassiveForce::Kind::point_spring:
        sum += point_spring_force(skeleton, force);
        break;
      case PassiveForce::Kind::bushing:
        sum += bushing_force(skeleton, force, coordinates, speeds);
        break;
    }
  }
  return sum;
}

}  // namespace gracilis::opensim
