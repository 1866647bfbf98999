#include "io/test_files.hpp"

#include <gracilis/io/tables/table.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>
#include <gracilis/opensim/static_optimization/joint_reactions.hpp>
#include <gracilis/opensim/static_optimization/needed_forces.hpp>
#include <gracilis/opensim/static_optimization/setup_reader.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

namespace {

/// The tutorial's walk: model with its residual actuators, motion, loads, and the forces that OpenSim found.
struct Walk {
  Model model;
  CoordinateMotion motion;
  ExternalLoads loads;
  Table forces;

  Walk() {
    const std::filesystem::path folder = data_root() / "opensim";
    const StaticOptimizationSetup setup = read_setup(folder / "setup_static_optimization.xml");
    model = read_model(folder / "subject01_simbody_adjusted_StaticOp.osim");
    for (const auto& set : setup.force_sets) read_force_set(set, false, model);
    motion = coordinate_motion(model, read_table(setup.coordinates));
    loads = read_external_loads(model, setup.external_loads);
    forces = read_table(folder / "subject01_StaticOptimization_force.sto");
  }
};

/// What a body does near a row, by differences of its poses alone.
struct BodyMotion {
  const Walk& walk;
  const Kinematics& kinematics;
  Skeleton& skeleton;
  std::size_t row;

  RigidTransform pose(std::size_t body, Real after) const {
    const auto i = static_cast<Eigen::Index>(row);
    const Eigen::VectorXd q = walk.motion.values.row(i).transpose() + after * kinematics.speeds.row(i).transpose() +
                              0.5 * after * after * kinematics.accelerations.row(i).transpose();
    skeleton.place(q);
    return skeleton.poses()[body];
  }
  Vec3 momentum_rate(std::size_t body) const {
    const Body& b = walk.model.bodies[body];
    const Real h = 1e-4;
    const auto center = [&](Real t) -> Vec3 { return pose(body, t) * b.mass_center; };
    return b.mass * (center(h) - 2 * center(0) + center(-h)) / (h * h);
  }
  Vec3 spin_at(std::size_t body, Real t) const {  // angular momentum about the center of mass
    const Real k = 1e-5;
    const Eigen::Matrix3d before = pose(body, t - k).linear(), after = pose(body, t + k).linear();
    const Eigen::Matrix3d r = pose(body, t).linear();
    const Eigen::AngleAxisd turn(after * before.transpose());
    return r * walk.model.bodies[body].inertia * r.transpose() * (turn.angle() / (2 * k) * turn.axis());
  }
  Vec3 spin_rate(std::size_t body) const {
    const Real h = 1e-3;
    return (spin_at(body, h) - spin_at(body, -h)) / (2 * h);
  }
};

}  // namespace

/// Every body but the pelvis, which residual actuators pull on: what its joints, muscles, loads and weight do is what
/// its motion takes.
TEST(JointReactions, balance_each_body_of_a_walk) {
  GRACILIS_NEEDS_DATA("opensim");
  const Walk walk;
  const Model& model = walk.model;
  const Kinematics kinematics(walk.motion);
  Skeleton skeleton(model);
  for (const std::size_t row : {50u, 110u, 170u}) {
    const Real time = walk.motion.times[row];
    const Table table = joint_reactions(model, walk.motion, walk.loads, {row}, walk.forces, {});
    const BodyMotion motion{walk, kinematics, skeleton, row};
    const Eigen::VectorXd q = walk.motion.values.row(static_cast<Eigen::Index>(row));
    skeleton.place(q);
    const std::vector<RigidTransform> poses = skeleton.poses();
    std::vector<Vec3> force(model.bodies.size(), Vec3::Zero()), moment = force, center = force;
    for (std::size_t b = 0; b < poses.size(); ++b) {
      center[b] = poses[b] * model.bodies[b].mass_center;
      force[b] = model.bodies[b].mass * model.gravity;
    }
    const auto act = [&](Index body, const Vec3& at, const Vec3& with) {
      const auto b = static_cast<std::size_t>(body);
      force[b] += with;
      moment[b] += (at - center[b]).cross(with);
    };
    BodyForces measured = BodyForces::Zero(6, static_cast<Eigen::Index>(poses.size()));
    add_loads(walk.loads, time, poses, measured);
    for (std::size_t b = 0; b < poses.size(); ++b) {
      act(static_cast<Index>(b), poses[b].translation(), measured.col(static_cast<Eigen::Index>(b)).tail<3>());
      moment[b] += measured.col(static_cast<Eigen::Index>(b)).head<3>();
    }
    for (const Muscle& muscle : model.muscles) {
      const auto at = std::find_if(walk.forces.times.begin(), walk.forces.times.end(),
                                   [&](Real t) { return std::abs(t - time) < 1e-6; });
      ASSERT_NE(at, walk.forces.times.end());
      const Real tension = walk.forces.values(at - walk.forces.times.begin(), *column_of(walk.forces, muscle.name));
      const std::vector<PathStop> stops = current_points(model, muscle.path, poses, q);
      for (std::size_t i = 1; i < stops.size(); ++i) {
        if (stops[i].wrap >= 0 && stops[i].wrap == stops[i - 1].wrap) continue;
        const Vec3 pull = tension * (stops[i].place - stops[i - 1].place).normalized();
        act(stops[i - 1].body, stops[i - 1].place, pull);
        act(stops[i].body, stops[i].place, -pull);
      }
    }
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      const auto column = static_cast<Eigen::Index>(9 * j);
      const Vec3 f = table.values.row(0).segment<3>(column), m = table.values.row(0).segment<3>(column + 3),
                 p = table.values.row(0).segment<3>(column + 6);
      act(model.joints[j].child_body, p, f);
      act(model.joints[j].parent_body, p, -f);
      moment[static_cast<std::size_t>(model.joints[j].child_body)] += m;
      moment[static_cast<std::size_t>(model.joints[j].parent_body)] -= m;
    }
    int judged = 0;
    for (std::size_t b = 1; b < poses.size(); ++b) {
      if (model.bodies[b].name == "pelvis") continue;
      // Thousands of newtons meet in a body; differences of poses keep six digits.
      EXPECT_LT((force[b] - motion.momentum_rate(b)).norm(), 2e-2) << model.bodies[b].name << " at " << time;
      EXPECT_LT((moment[b] - motion.spin_rate(b)).norm(), 2e-2) << model.bodies[b].name << " at " << time;
      ++judged;
    }
    EXPECT_EQ(judged, 11);
  }
}

}  // namespace gracilis::opensim
