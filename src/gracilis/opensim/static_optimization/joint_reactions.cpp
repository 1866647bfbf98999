#include <gracilis/opensim/static_optimization/joint_reactions.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/opensim/kinematics/loop_closer.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>
#include <gracilis/opensim/static_optimization/active_forces.hpp>
#include <gracilis/opensim/static_optimization/needed_forces.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace gracilis::opensim {

namespace {

/// A joint whose load is asked for.
struct AskedReaction {
  const Joint* joint = nullptr;
  bool on_child = true;
  Index frame = 0;  ///< body
};

}  // namespace

static Index frame_of(const Model& model, const Joint& joint, const std::string& named) {
  if (lower_case(named) == "child") return joint.child_body;
  if (lower_case(named) == "parent") return joint.parent_body;
  const std::string name = named.substr(named.rfind('/') + 1);
  const Index body = index_of(model.bodies, name);
  if (body >= 0) return body;
  throw InputError({model.name, joint.name, fmt::format("'{}' is no body to express reactions in", named),
                    "give child, parent, or a body's name: " + suggestion(name, names_of(model.bodies))});
}

static std::vector<AskedReaction> asked_reactions(const Model& model, const ReactionSettings& settings) {
  std::vector<std::string> joints = settings.joints;
  if (joints.empty() || lower_case(joints[0]) == "all") joints = names_of(model.joints);
  const auto entry = [&](const std::vector<std::string>& list, std::size_t i, const char* otherwise) {
    if (list.size() == joints.size()) return list[i];
    return list.size() == 1 ? list[0] : std::string(otherwise);
  };
  std::vector<AskedReaction> asked;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Index index = index_of(model.joints, joints[i]);
    if (index < 0)
      throw InputError(
          {model.name, "", fmt::format("has no joint '{}'", joints[i]), suggestion(joints[i], names_of(model.joints))});
    const Joint& joint = model.joints[static_cast<std::size_t>(index)];
    asked.push_back({&joint, lower_case(entry(settings.on, i, "child")) != "parent",
                     frame_of(model, joint, entry(settings.in, i, "ground"))});
  }
  return asked;
}

/// A column of the table for each muscle and actuator.
static std::vector<Eigen::Index> force_columns(const Table& forces, const std::vector<std::string>& names) {
  std::vector<Eigen::Index> columns;
  for (const std::string& name : names) {
    const auto column = column_of(forces, name);
    if (!column)
      throw InputError({forces.name, "", fmt::format("has no force of '{}'", name),
                        "name forces of all muscles and actuators, such as those of static optimization"});
    columns.push_back(*column);
  }
  return columns;
}

/// All columns at a time, straight between rows.
static Eigen::VectorXd row_at(const Table& table, Real time) {
  const auto after = std::lower_bound(table.times.begin(), table.times.end(), time - 1e-9) - table.times.begin();
  const auto last = static_cast<std::ptrdiff_t>(table.times.size()) - 1;
  const auto right = std::clamp<std::ptrdiff_t>(after, 0, last), left = std::max<std::ptrdiff_t>(right - 1, 0);
  const Real begin = table.times[static_cast<std::size_t>(left)], end = table.times[static_cast<std::size_t>(right)];
  const Real share = end > begin ? std::clamp((time - begin) / (end - begin), 0.0, 1.0) : 1;
  return (1 - share) * table.values.row(left) + share * table.values.row(right);
}

/// What muscles and actuators do with these forces.
static AppliedForces active_pulls(const Skeleton& skeleton, const ActiveForces& active,
                                  const Eigen::VectorXd& coordinates, const Eigen::VectorXd& forces) {
  AppliedForces sum(skeleton.model());
  Eigen::Index i = 0;
  for (const Muscle* muscle : active.muscles) sum.add(unit_pull(skeleton, muscle->path, coordinates), forces[i++]);
  for (const Actuator* actuator : active.actuators) sum.add(unit_effect(skeleton, *actuator), forces[i++]);
  return sum;
}

/// What closes loops does on bodies: what other forces leave undone.
static BodyForces loop_pulls(const Skeleton& skeleton, const Eigen::VectorXd& coordinates,
                             const Eigen::VectorXd& undone) {
  const Eigen::MatrixXd slopes = independent_loop_slopes(skeleton, coordinates);
  const std::vector<Eigen::Index> free = free_coordinates(skeleton.model());
  const Eigen::MatrixXd work = slopes(Eigen::all, free).transpose();
  return skeleton.loop_forces(work.completeOrthogonalDecomposition().solve(undone(free)));
}

/// What each body needs from its joints, torques about its origin.
static BodyForces needed_from_joints(Skeleton& skeleton, const Kinematics& kinematics, const ExternalLoads& loads,
                                     std::size_t row, const ActiveForces& active, const Eigen::VectorXd& forces) {
  const auto i = static_cast<Eigen::Index>(row);
  const Eigen::VectorXd coordinates = kinematics.motion.values.row(i);
  AppliedForces applied = outer_forces(skeleton, kinematics, loads, row);
  applied.add(active_pulls(skeleton, active, coordinates, forces));
  BodyForces needed =
      skeleton.needed_on_bodies(kinematics.speeds.row(i), kinematics.accelerations.row(i), applied.bodies);
  if (skeleton.model().loops.empty()) return needed;
  const Eigen::VectorXd undone = skeleton.generalized_forces(needed) - applied.coordinates;
  needed -= loop_pulls(skeleton, coordinates, onto_independent(skeleton.model(), coordinates, undone));
  return needed;
}

/// The load of each joint on its child, about the child's origin (rows: torque, force), a column per body.
static BodyForces joint_loads(const Skeleton& skeleton, BodyForces needed) {
  const auto& joints = skeleton.model().joints;
  const auto& poses = skeleton.poses();
  for (auto joint = joints.rbegin(); joint != joints.rend(); ++joint) {
    const Eigen::Vector<Real, 6> load = needed.col(joint->child_body);
    const RigidTransform& parent = poses[static_cast<std::size_t>(joint->parent_body)];
    const Vec3 origin = poses[static_cast<std::size_t>(joint->child_body)].translation();
    needed.col(joint->parent_body).head<3>() += load.head<3>();
    add_force(needed, joint->parent_body, parent, origin, load.tail<3>());
  }
  return needed;
}

/// Force, moment and point as asked.
static Eigen::Vector<Real, 9> reaction(const AskedReaction& asked, const BodyForces& loads,
                                       const std::vector<RigidTransform>& poses) {
  const Joint& joint = *asked.joint;
  const RigidTransform& child = poses[static_cast<std::size_t>(joint.child_body)];
  const RigidTransform& parent = poses[static_cast<std::size_t>(joint.parent_body)];
  const RigidTransform& frame = poses[static_cast<std::size_t>(asked.frame)];
  const Vec3 point =
      asked.on_child ? child * joint.child_frame.translation() : parent * joint.parent_frame.translation();
  const Real sign = asked.on_child ? 1 : -1;
  const Vec3 force = sign * loads.col(joint.child_body).tail<3>();
  const Vec3 moment = sign * loads.col(joint.child_body).head<3>() + (child.translation() - point).cross(force);
  Eigen::Vector<Real, 9> result;
  result << frame.linear().transpose() * force, frame.linear().transpose() * moment, frame.inverse() * point;
  return result;
}

static std::vector<std::string> reaction_columns(const Model& model, const std::vector<AskedReaction>& asked) {
  const auto body = [&](Index i) { return model.bodies[static_cast<std::size_t>(i)].name; };
  std::vector<std::string> columns;
  for (const AskedReaction& each : asked) {
    const Index on = each.on_child ? each.joint->child_body : each.joint->parent_body;
    for (const char* part : {"fx", "fy", "fz", "mx", "my", "mz", "px", "py", "pz"})
      columns.push_back(fmt::format("{}_on_{}_in_{}_{}", each.joint->name, body(on), body(each.frame), part));
  }
  return columns;
}

Table joint_reactions(const Model& model, const CoordinateMotion& motion, const ExternalLoads& loads,
                      const std::vector<std::size_t>& rows, const Table& forces, const ReactionSettings& settings) {
  const Kinematics kinematics(motion);
  const ActiveForces active(model);
  const std::vector<Eigen::Index> columns = force_columns(forces, active.names());
  const std::vector<AskedReaction> asked = asked_reactions(model, settings);
  Table table;
  table.name = "Joint Reaction Loads";
  table.columns = reaction_columns(model, asked);
  table.values.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(table.columns.size()));
  Skeleton skeleton(model);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Real time = motion.times[rows[i]];
    table.times.push_back(time);
    const Eigen::VectorXd now = row_at(forces, time)(columns);
    const BodyForces on_children =
        joint_loads(skeleton, needed_from_joints(skeleton, kinematics, loads, rows[i], active, now));
    for (std::size_t k = 0; k < asked.size(); ++k)
      table.values.row(static_cast<Eigen::Index>(i)).segment<9>(static_cast<Eigen::Index>(9 * k)) =
          reaction(asked[k], on_children, skeleton.poses());
  }
  return table;
}

}  // namespace gracilis::opensim
