#include <gracilis/opensim/kinematics/skeleton.hpp>

#include <gracilis/core/errors.hpp>

#include <Simbody.h>

namespace gracilis::opensim {

static SimTK::Vec3 to_simbody(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

static SimTK::Transform to_simbody(const RigidTransform& t) {
  SimTK::Mat33 matrix;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) matrix(row, column) = t.linear()(row, column);
  return {SimTK::Rotation(matrix), to_simbody(Vec3(t.translation()))};
}

static RigidTransform from_simbody(const SimTK::Transform& t) {
  RigidTransform result = RigidTransform::Identity();
  for (int row = 0; row < 3; ++row) {
    result.translation()[row] = t.p()[row];
    for (int column = 0; column < 3; ++column) result.linear()(row, column) = t.R().asMat33()(row, column);
  }
  return result;
}

namespace {

/// Our functions as Simbody wants them.
class AxisFunction : public SimTK::Function {
 public:
  explicit AxisFunction(const TransformAxis& axis) : axis_(axis) {}
  SimTK::Real calcValue(const SimTK::Vector& x) const override { return value(axis_.function, arguments(x)); }
  SimTK::Real calcDerivative(const SimTK::Array_<int>& by, const SimTK::Vector& x) const override {
    return derivative(axis_.function, arguments(x), {by.begin(), by.end()});
  }
  int getArgumentSize() const override { return static_cast<int>(axis_.coordinates.size()); }
  int getMaxDerivativeOrder() const override { return 2; }

 private:
  static std::vector<Real> arguments(const SimTK::Vector& x) {
    std::vector<Real> values;
    for (int i = 0; i < x.size(); ++i) values.push_back(x[i]);
    return values;
  }
  TransformAxis axis_;
};

}  // namespace

struct Skeleton::Tree {
  explicit Tree(const Model& the_model) : model(the_model), matter(system) {}
  const Model& model;
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::State state;
  std::vector<SimTK::MobilizedBodyIndex> bodies;  ///< of Simbody, for each of ours
  std::vector<int> coordinates;                   ///< index among Simbody's, for each of ours
  std::vector<RigidTransform> poses;

  SimTK::Vector sorted(const Eigen::VectorXd& values) const {
    SimTK::Vector result(static_cast<int>(values.size()));
    for (std::size_t i = 0; i < coordinates.size(); ++i) result[coordinates[i]] = values[static_cast<Eigen::Index>(i)];
    return result;
  }
  Eigen::VectorXd unsorted(const SimTK::Vector& values) const {
    Eigen::VectorXd result(static_cast<Eigen::Index>(coordinates.size()));
    for (std::size_t i = 0; i < coordinates.size(); ++i) result[static_cast<Eigen::Index>(i)] = values[coordinates[i]];
    return result;
  }
  SimTK::Vector_<SimTK::SpatialVec> spatial(const BodyForces& forces) const {
    SimTK::Vector_<SimTK::SpatialVec> result(matter.getNumBodies(), SimTK::SpatialVec(SimTK::Vec3(0), SimTK::Vec3(0)));
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Eigen::Vector<Real, 6> f = forces.col(static_cast<Eigen::Index>(i));
      result[bodies[i]] += SimTK::SpatialVec({f[0], f[1], f[2]}, {f[3], f[4], f[5]});
    }
    return result;
  }
};

/// Simbody is asked for kinematics only. Masses are ours: some models have moments of inertia that no rigid body can
/// have, and it refuses those.
static SimTK::Body::Rigid any_body() {
  return SimTK::Body::Rigid(SimTK::MassProperties(1, SimTK::Vec3(0), SimTK::Inertia(1)));
}

/// Where a joint without coordinates holds the child in the parent's frame of the joint.
static RigidTransform fixed_transform(const Joint& joint) {
  RigidTransform fixed = RigidTransform::Identity();
  for (std::size_t i = 3; i < 6; ++i) fixed.translation() += value(joint.axes[i].function, {}) * joint.axes[i].axis;
  for (std::size_t i = 0; i < 3; ++i)
    fixed.rotate(Eigen::AngleAxisd(value(joint.axes[i].function, {}), joint.axes[i].axis));
  return fixed;
}

static SimTK::MobilizedBody add_joint(const Joint& joint, SimTK::MobilizedBody& parent, const SimTK::Body& body) {
  const SimTK::Transform child_frame = to_simbody(joint.child_frame);
  if (joint.coordinates.empty())
    return SimTK::MobilizedBody::Weld(parent, to_simbody(joint.parent_frame * fixed_transform(joint)), body,
                                      child_frame);
  SimTK::Array_<const SimTK::Function*> functions;
  SimTK::Array_<SimTK::Array_<int>> arguments;
  SimTK::Array_<SimTK::Vec3> axes;
  for (const TransformAxis& axis : joint.axes) {
    functions.push_back(new AxisFunction(axis));  // the mobilizer deletes it
    axes.push_back(to_simbody(axis.axis));
    SimTK::Array_<int> places;
    for (const Index coordinate : axis.coordinates)
      places.push_back(static_cast<int>(std::find(joint.coordinates.begin(), joint.coordinates.end(), coordinate) -
                                        joint.coordinates.begin()));
    arguments.push_back(places);
  }
  return SimTK::MobilizedBody::FunctionBased(parent, to_simbody(joint.parent_frame), body, child_frame,
                                             static_cast<int>(joint.coordinates.size()), functions, arguments, axes);
}

static void add_loop(const LoopConstraint& loop, SimTK::MobilizedBody first, SimTK::MobilizedBody second) {
  const SimTK::Transform frame = to_simbody(loop.frame), other = to_simbody(loop.other_frame);
  switch (loop.kind) {
    case LoopConstraint::Kind::point:
      SimTK::Constraint::Ball(first, frame.p(), second, other.p());
      break;
    case LoopConstraint::Kind::distance:
      SimTK::Constraint::Rod(first, frame.p(), second, other.p(), loop.distance);
      break;
    case LoopConstraint::Kind::weld:
      SimTK::Constraint::Weld(first, frame, second, other);
      break;
  }
}

Skeleton::Skeleton(const Model& model) : tree_(std::make_unique<Tree>(model)) {
  Tree& tree = *tree_;
  tree.bodies.assign(model.bodies.size(), tree.matter.getGround().getMobilizedBodyIndex());
  tree.coordinates.resize(model.coordinates.size());
  const Joint* current = nullptr;
  try {
    for (const Joint& joint : model.joints) {
      current = &joint;
      SimTK::MobilizedBody parent =
          tree.matter.getMobilizedBody(tree.bodies[static_cast<std::size_t>(joint.parent_body)]);
      const auto child = static_cast<std::size_t>(joint.child_body);
      tree.bodies[child] = add_joint(joint, parent, any_body()).getMobilizedBodyIndex();
    }
    for (const LoopConstraint& loop : model.loops)
      add_loop(loop, tree.matter.updMobilizedBody(tree.bodies[static_cast<std::size_t>(loop.body)]),
               tree.matter.updMobilizedBody(tree.bodies[static_cast<std::size_t>(loop.other_body)]));
    tree.state = tree.system.realizeTopology();
    tree.system.realize(tree.state, SimTK::Stage::Model);
  } catch (const std::exception& error) {
    throw InputError({model.name, current ? current->name : "",
                      std::string("cannot become a multibody system: ") + error.what(), "check the joint's axes"});
  }
  for (const Joint& joint : model.joints) {
    if (joint.coordinates.empty()) continue;
    const auto& body = tree.matter.getMobilizedBody(tree.bodies[static_cast<std::size_t>(joint.child_body)]);
    int first = body.getFirstQIndex(tree.state);
    for (const Index i : joint.coordinates) tree.coordinates[static_cast<std::size_t>(i)] = first++;
  }
  place(default_coordinates(model));
}

Skeleton::~Skeleton() = default;

const Model& Skeleton::model() const { return tree_->model; }

void Skeleton::place(const Eigen::VectorXd& coordinates) {
  Tree& tree = *tree_;
  tree.state.updQ() = tree.sorted(coordinates);
  tree.system.realize(tree.state, SimTK::Stage::Position);
  tree.poses.resize(tree.bodies.size());
  for (std::size_t i = 0; i < tree.bodies.size(); ++i)
    tree.poses[i] = from_simbody(tree.matter.getMobilizedBody(tree.bodies[i]).getBodyTransform(tree.state));
}

const std::vector<RigidTransform>& Skeleton::poses() const { return tree_->poses; }

Eigen::VectorXd Skeleton::generalized_forces(const BodyForces& forces) const {
  SimTK::Vector result;
  tree_->matter.multiplyBySystemJacobianTranspose(tree_->state, tree_->spatial(forces), result);
  return tree_->unsorted(result);
}

/// The force and the torque about the body's origin that give a body this motion (Newton and Euler).
static Eigen::Vector<Real, 6> inertial_force(const Body& body, const RigidTransform& pose,
                                             const SimTK::SpatialVec& speed, const SimTK::SpatialVec& acceleration,
                                             const Vec3& gravity) {
  const auto vec = [](const SimTK::Vec3& v) { return Vec3(v[0], v[1], v[2]); };
  const Vec3 turning = vec(speed[0]), turning_faster = vec(acceleration[0]);
  const Vec3 arm = pose.linear() * body.mass_center;
  const Vec3 of_center = vec(acceleration[1]) + turning_faster.cross(arm) + turning.cross(turning.cross(arm));
  const Eigen::Matrix3d inertia = pose.linear() * body.inertia * pose.linear().transpose();
  const Vec3 force = body.mass * (of_center - gravity);
  const Vec3 torque = inertia * turning_faster + turning.cross(inertia * turning);
  Eigen::Vector<Real, 6> result;
  result << torque + arm.cross(force), force;
  return result;
}

BodyForces Skeleton::needed_on_bodies(const Eigen::VectorXd& speeds, const Eigen::VectorXd& accelerations,
                                      const BodyForces& applied) const {
  Tree& tree = *tree_;
  tree.state.updU() = tree.sorted(speeds);
  tree.system.realize(tree.state, SimTK::Stage::Velocity);
  SimTK::Vector_<SimTK::SpatialVec> moved;
  tree.matter.calcBodyAccelerationFromUDot(tree.state, tree.sorted(accelerations), moved);
  BodyForces forces = -applied;
  for (std::size_t i = 1; i < tree.poses.size(); ++i) {
    const SimTK::SpatialVec speed = tree.matter.getMobilizedBody(tree.bodies[i]).getBodyVelocity(tree.state);
    forces.col(static_cast<Eigen::Index>(i)) +=
        inertial_force(tree.model.bodies[i], tree.poses[i], speed, moved[tree.bodies[i]], tree.model.gravity);
  }
  return forces;
}

Eigen::VectorXd Skeleton::inverse_dynamics(const Eigen::VectorXd& speeds, const Eigen::VectorXd& accelerations,
                                           const BodyForces& applied) const {
  return generalized_forces(needed_on_bodies(speeds, accelerations, applied));
}

Eigen::VectorXd Skeleton::loop_errors() const {
  const SimTK::Vector& errors = tree_->state.getQErr();
  Eigen::VectorXd result(errors.size());
  for (int i = 0; i < errors.size(); ++i) result[i] = errors[i];
  return result;
}

Eigen::MatrixXd Skeleton::loop_slopes() const {
  SimTK::Matrix slopes;  // by rates of coordinates, which are this tree's speeds
  tree_->matter.calcPq(tree_->state, slopes);
  Eigen::MatrixXd result(slopes.nrow(), static_cast<Eigen::Index>(tree_->coordinates.size()));
  for (int row = 0; row < slopes.nrow(); ++row)
    for (std::size_t i = 0; i < tree_->coordinates.size(); ++i)
      result(row, static_cast<Eigen::Index>(i)) = slopes(row, tree_->coordinates[i]);
  return result;
}

BodyForces Skeleton::loop_forces(const Eigen::VectorXd& multipliers) const {
  SimTK::Vector lambda(static_cast<int>(multipliers.size()));
  for (int i = 0; i < lambda.size(); ++i) lambda[i] = multipliers[i];
  SimTK::Vector_<SimTK::SpatialVec> on_bodies;
  SimTK::Vector on_coordinates;  // none: loops hold bodies
  tree_->system.realize(tree_->state, SimTK::Stage::Velocity);
  tree_->matter.calcConstraintForcesFromMultipliers(tree_->state, lambda, on_bodies, on_coordinates);
  BodyForces result = BodyForces::Zero(6, static_cast<Eigen::Index>(tree_->bodies.size()));
  for (std::size_t i = 0; i < tree_->bodies.size(); ++i)
    for (int k = 0; k < 6; ++k) result(k, static_cast<Eigen::Index>(i)) = on_bodies[tree_->bodies[i]][k / 3][k % 3];
  return result;
}

Eigen::VectorXd Skeleton::generalized_forces(const AppliedForces& forces) const {
  return generalized_forces(forces.bodies) + forces.coordinates;
}

AppliedForces::AppliedForces(const Model& model)
    : bodies(BodyForces::Zero(6, static_cast<Eigen::Index>(model.bodies.size()))),
      coordinates(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.coordinates.size()))) {}

void AppliedForces::add(const AppliedForces& others, Real times) {
  bodies += times * others.bodies;
  coordinates += times * others.coordinates;
}

void add_force(BodyForces& forces, Index body, const RigidTransform& pose, const Vec3& point, const Vec3& force) {
  forces.col(body).head<3>() += (point - pose.translation()).cross(force);
  forces.col(body).tail<3>() += force;
}

Eigen::VectorXd onto_independent(const Model& model, const Eigen::VectorXd& coordinates, Eigen::VectorXd forces) {
  // Last first: a coupler may drive another's independent coordinate.
  for (auto coupler = model.couplers.rbegin(); coupler != model.couplers.rend(); ++coupler) {
    std::vector<Real> arguments;
    for (const Index i : coupler->independent) arguments.push_back(coordinates[i]);
    for (std::size_t i = 0; i < arguments.size(); ++i)
      forces[coupler->independent[i]] +=
          forces[coupler->dependent] * derivative(coupler->function, arguments, {static_cast<int>(i)});
    forces[coupler->dependent] = 0;
  }
  return forces;
}

}  // namespace gracilis::opensim
