#include <gracilis/opensim/static_optimization/passive_forces.hpp>

#include <gracilis/opensim/functions/expression.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

using Vec6 = Eigen::Matrix<Real, 6, 1>;

static const RigidTransform& pose_of(const Skeleton& skeleton, Index body) {
  return skeleton.poses()[static_cast<std::size_t>(body)];
}

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

/// Of Blankevoort1991Ligament, by strain and its rate.
static Real toe_tension(const PassiveForce& force, Real strain, Real rate) {
  const Real toe = force.transition_strain;
  const Real spring =
      strain < toe ? 0.5 * force.stiffness / toe * strain * strain : force.stiffness * (strain - toe / 2);
  const Real damping = rate > 0 ? force.damping * rate * smooth_step(strain / 0.01) : 0;
  return spring + damping;
}

/// The tension of a path that is longer than at rest.
static Real tension_of(const PassiveForce& force, Real length, Real speed) {
  if (length <= force.rest_length) return 0;
  if (force.kind == PassiveForce::Kind::ligament)
    return force.pcsa_force * value(force.curve, {length / force.rest_length});
  if (force.kind == PassiveForce::Kind::toe_ligament)
    return toe_tension(force, length / force.rest_length - 1, speed / force.rest_length);
  return force.stiffness * (length - force.rest_length) * (1 + force.damping * speed);
}

static void add_path_force(const Skeleton& skeleton, const PassiveForce& force, const Eigen::VectorXd& coordinates,
                           const Eigen::VectorXd& speeds, AppliedForces& sum) {
  const PathMeasure path = measure_path(skeleton, force.path, coordinates);
  if (const Real tension = tension_of(force, path.length, -path.moment_arms.dot(speeds)); tension != 0)
    sum.add(unit_pull(skeleton, force.path, coordinates), tension);
}

/// Both points of a force between two, in the ground frame.
static std::pair<Vec3, Vec3> points_of(const Skeleton& skeleton, const PassiveForce& force) {
  return {pose_of(skeleton, force.body) * force.frame.translation(),
          pose_of(skeleton, force.other_body) * force.other_frame.translation()};
}

/// `apart` pushes the points from each other.
static void add_between_points(const Skeleton& skeleton, const PassiveForce& force, Real apart, AppliedForces& sum) {
  const auto [from, to] = points_of(skeleton, force);
  const Real length = (to - from).norm();
  if (length == 0) return;
  const Vec3 push = apart / length * (to - from);
  add_force(sum.bodies, force.body, pose_of(skeleton, force.body), from, -push);
  add_force(sum.bodies, force.other_body, pose_of(skeleton, force.other_body), to, push);
}

static Real distance_of(const Skeleton& skeleton, const PassiveForce& force) {
  const auto [from, to] = points_of(skeleton, force);
  return (to - from).norm();
}

/// Where the second frame lies in the first: rotations about x, then the new y, then the new z, and the translation.
static Vec6 bushing_place(const Skeleton& skeleton, const PassiveForce& force) {
  const RigidTransform first = pose_of(skeleton, force.body) * force.frame;
  const RigidTransform between = first.inverse() * (pose_of(skeleton, force.other_body) * force.other_frame);
  const auto& r = between.linear();
  Vec6 place;
  place << std::atan2(-r(1, 2), r(2, 2)), std::asin(std::clamp(r(0, 2), -1.0, 1.0)), std::atan2(-r(0, 1), r(0, 0)),
      between.translation();
  return place;
}

/// How fast `measure` changes with the motion, by central differences.
template <class F>
static auto rate_of(Skeleton& skeleton, const Eigen::VectorXd& coordinates, const Eigen::VectorXd& speeds,
                    const F& measure) {
  const Real step = 1e-5 / std::max(speeds.lpNorm<Eigen::Infinity>(), 1.0);  // s
  skeleton.place(coordinates + step * speeds);
  const auto after = measure();
  skeleton.place(coordinates - step * speeds);
  const auto before = measure();
  skeleton.place(coordinates);
  return decltype(after)((after - before) / (2 * step));
}

/// OpenSim's formulas between points are of what pulls them together.
static Real formula_pull(Skeleton& skeleton, const PassiveForce& force, const Eigen::VectorXd& coordinates,
                         const Eigen::VectorXd& speeds) {
  const Real rate = rate_of(skeleton, coordinates, speeds, [&] { return distance_of(skeleton, force); });
  return value(force.formulas[0], {{"d", distance_of(skeleton, force)}, {"ddot", rate}});
}

static Vec6 bushing_pull(const PassiveForce& force, const Vec6& place) {
  if (force.kind == PassiveForce::Kind::bushing) return force.stiffnesses.cwiseProduct(place);
  const Variables variables = {{"theta_x", place[0]}, {"theta_y", place[1]}, {"theta_z", place[2]},
                               {"delta_x", place[3]}, {"delta_y", place[4]}, {"delta_z", place[5]}};
  Vec6 pull;
  for (std::size_t i = 0; i < 6; ++i) pull[static_cast<Eigen::Index>(i)] = value(force.formulas[i], variables);
  return pull;
}

/// The moment, in the turned frame's axes, that does the same work as moments conjugate to the three angles.
static Vec3 moment_of_angles(const Vec6& place, const Vec3& moments) {
  Eigen::Matrix3d turning;  // angular velocity in the turned frame by rates of angles
  const Real cy = std::cos(place[1]), sy = std::sin(place[1]), cz = std::cos(place[2]), sz = std::sin(place[2]);
  turning << cy * cz, sz, 0, -cy * sz, cz, 0, sy, 0, 1;
  return turning.transpose().colPivHouseholderQr().solve(moments);
}

static void add_bushing(Skeleton& skeleton, const PassiveForce& force, const Eigen::VectorXd& coordinates,
                        const Eigen::VectorXd& speeds, AppliedForces& sum) {
  const Vec6 rate = rate_of(skeleton, coordinates, speeds, [&] { return bushing_place(skeleton, force); });
  const Vec6 place = bushing_place(skeleton, force);
  const Vec6 pull = -bushing_pull(force, place) - force.dampings.cwiseProduct(rate);
  const RigidTransform& pose = pose_of(skeleton, force.body);
  const RigidTransform& other = pose_of(skeleton, force.other_body);
  const RigidTransform first = pose * force.frame, second = other * force.other_frame;
  const Vec3 push = first.linear() * pull.tail<3>();
  const Vec3 moment = second.linear() * moment_of_angles(place, pull.head<3>());
  add_force(sum.bodies, force.other_body, other, second.translation(), push);
  add_force(sum.bodies, force.body, pose, second.translation(), -push);
  sum.bodies.col(force.other_body).head<3>() += moment;
  sum.bodies.col(force.body).head<3>() -= moment;
}

static void add_coordinate_force(const PassiveForce& force, Real q, Real speed, AppliedForces& sum) {
  Real& on_coordinate = sum.coordinates[force.coordinate];
  if (force.kind == PassiveForce::Kind::limit)
    on_coordinate += limit_force(force, q, speed);
  else if (force.kind == PassiveForce::Kind::formula_coordinate)
    on_coordinate += value(force.formulas[0], {{"q", q}, {"qdot", speed}});
  else
    on_coordinate -= force.stiffness * (q - force.rest_length) + force.damping * speed;
}

AppliedForces passive_forces(Skeleton& skeleton, const Eigen::VectorXd& coordinates, const Eigen::VectorXd& speeds) {
  AppliedForces sum(skeleton.model());
  for (const PassiveForce& force : skeleton.model().passive_forces) {
    if (!force.applies_force) continue;
    switch (force.kind) {
      case PassiveForce::Kind::limit:
      case PassiveForce::Kind::coordinate_spring:
      case PassiveForce::Kind::formula_coordinate:
        add_coordinate_force(force, coordinates[force.coordinate], speeds[force.coordinate], sum);
        break;
      case PassiveForce::Kind::path_spring:
      case PassiveForce::Kind::ligament:
      case PassiveForce::Kind::toe_ligament:
        add_path_force(skeleton, force, coordinates, speeds, sum);
        break;
      case PassiveForce::Kind::point_spring:
        add_between_points(skeleton, force, -force.stiffness * (distance_of(skeleton, force) - force.rest_length), sum);
        break;
      case PassiveForce::Kind::formula_points:
        add_between_points(skeleton, force, -formula_pull(skeleton, force, coordinates, speeds), sum);
        break;
      case PassiveForce::Kind::bushing:
      case PassiveForce::Kind::formula_bushing:
        add_bushing(skeleton, force, coordinates, speeds, sum);
        break;
    }
  }
  return sum;
}

}  // namespace gracilis::opensim
