#include <gracilis/anatomy/joints/joint_twists.hpp>
#include <gracilis/methods/placed_method.hpp>
#include <gracilis/methods/tissue/tissue_method.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include "tissue_bar.hpp"

namespace gracilis {
namespace {

using namespace tissue;

TEST(TissueForces, the_tension_of_an_active_bar_is_activation_times_stress_times_section) {
  const SettledBar bar = settled(
      {{"largest_active_stress", 3e5}, {"shear_per_tension", 0.25}, {"bulk_per_tension", 10.0}}, 0.4, Vec3::Zero());
  const Real expected = 0.4 * 3e5 * section;
  EXPECT_NEAR(mean_tension(bar.muscle, cell_laws(bar.muscle, 0.4, 1), bar.nodes), expected, 0.01 * expected);
  EXPECT_NEAR(bar.muscle.mean_section, section, 0.01 * section);
}

TEST(TissueForces, the_stress_at_the_surface_is_that_of_the_fibers_there) {
  const Scene scene = bar_scene({{"fiber_tension", 2e4}, {"fiber_stiffness", 5e4}});
  const PreparedTissue muscle = prepare_tissue(scene, scene.muscles[0], {}, {});
  // Of one material, evenly stretched.
  std::vector<CellLaw> laws = cell_laws(muscle, 0.3, 1);
  for (CellLaw& law : laws) law = laws[laws.size() / 2];
  const Points nodes = Vec3(0.9, 0.9, 1.2).asDiagonal() * muscle.lattice.nodes;
  const Eigen::VectorXd stresses = vertex_fiber_stresses(muscle, laws, nodes);
  ASSERT_EQ(stresses.size(), muscle.vertex_count);
  const Real expected = fiber_curve(laws[0].fibers, 1.2).slope;
  // Where fibers begin they do not all run straight along the bar.
  for (const Real stress : stresses) EXPECT_NEAR(stress, expected, 0.03 * expected);
  EXPECT_EQ(vertex_fiber_stresses(muscle, cell_laws(muscle, 0, 0), nodes).norm(), 0);
}

/// The tube of the tests, bent, under tension and active, at rest.
class BentTube : public ::testing::Test {
 protected:
  static constexpr Real activation = 0.3;

  Scene scene = [] {
    Scene tube = tube_scene();
    tube.method.name = "tissue";
    tube.method.settings = {{"cell_size", 0.008}, {"cells_at_least", 0}};
    return tube;
  }();
  PreparedTissue muscle = [this] {
    std::vector<SignedDistance> distances;
    for (const Bone& bone : scene.bones) distances.emplace_back(bone.surface);
    return prepare_tissue(scene, scene.muscles[0], tube_fields(), distances);
  }();
  std::vector<CellLaw> laws = cell_laws(muscle, activation, 1);
  FactoredMatrix metric{scalar_stiffness(muscle, laws)};

  struct Settled {
    Points nodes;
    Surroundings around;
    Real energy = 0;
  };
  Settled settle(const std::vector<RigidTransform>& from, Points nodes, Real angle) const {
    const std::vector<RigidTransform> bodies = flexed(scene, angle).bodies;
    carry(muscle, from, bodies, nodes);
    Settled found{std::move(nodes), surroundings(muscle, bodies, laws), 0};
    for (int round = 0; round < 3; ++round) {
      find_near_bones(muscle, found.nodes, found.around);
      const Minimized done = minimize([&](const Points& x, Points& g) { return energy_of(muscle, found.around, x, g); },
                                      [&](std::span<Points> g) { metric.solve(g); }, {3000, 1e-6, 0.005}, found.nodes);
      found.energy = done.energy;
    }
    return found;
  }
  Settled bent(Real angle) const {
    std::vector<RigidTransform> bodies(2, RigidTransform::Identity());
    Points nodes = muscle.lattice.nodes;
    Settled found;
    for (int step = 1; step <= 4; ++step) {
      found = settle(bodies, nodes, angle * step / 4);
      nodes = found.nodes, bodies = found.around.bodies;
    }
    return found;
  }
};

TEST_F(BentTube, all_forces_on_bodies_and_bones_balance) {
  const Settled found = bent(radians(30));
  const MuscleForces forces = muscle_forces(muscle, found.around, laws, found.nodes, {});
  Wrench sum;
  Real contact = 0;
  for (const std::vector<ForceOn>* list : {&forces.origin, &forces.insertion, &forces.fascia, &forces.contact})
    for (const ForceOn& each : *list) sum.force += each.wrench.force, sum.moment += each.wrench.moment;
  for (const ForceOn& each : forces.contact) contact += each.wrench.force.norm();
  EXPECT_GT(forces.tension, 10);
  EXPECT_GT(contact, 0.1) << "it lies on the bones";
  EXPECT_LT(sum.force.norm(), 1e-4 * forces.tension);
  EXPECT_LT(sum.moment.norm(), 1e-4 * forces.tension * 0.1);
}

TEST_F(BentTube, the_moment_of_all_forces_is_what_the_energy_at_rest_loses_along_the_coordinate) {
  const Real angle = radians(30), h = radians(0.5);
  const Settled found = bent(angle);
  const std::vector<std::vector<Twist>> twists = joint_twists(scene, std::vector<Real>{angle});
  const MuscleForces forces = muscle_forces(muscle, found.around, laws, found.nodes, twists);
  const Real above = settle(found.around.bodies, found.nodes, angle + h).energy,
             below = settle(found.around.bodies, found.nodes, angle - h).energy;
  ASSERT_EQ(forces.moments.size(), 1U);
  EXPECT_GT(std::abs(forces.moments[0]), 0.1);
  EXPECT_NEAR(forces.moments[0], (below - above) / (2 * h), 0.01 * std::abs(forces.moments[0]));
  EXPECT_NEAR(forces.moments_by_work[0], forces.moments[0], 0.001 * std::abs(forces.moments[0]));
}

TEST_F(BentTube, away_from_rest_moments_of_forces_and_of_work_differ) {
  const std::vector<RigidTransform> bodies = flexed(scene, radians(10)).bodies;
  Points nodes = muscle.lattice.nodes;
  carry(muscle, std::vector<RigidTransform>(2, RigidTransform::Identity()), bodies, nodes);
  const MuscleForces forces = muscle_forces(muscle, surroundings(muscle, bodies, laws), laws, nodes,
                                            joint_twists(scene, std::vector<Real>{radians(10)}));
  EXPECT_GT(std::abs(forces.moments[0] - forces.moments_by_work[0]), 0.1);
}

TEST_F(BentTube, fibers_together_have_the_tension_of_the_muscle) {
  scene.muscles[0].fibers.count = 40;
  std::vector<SignedDistance> distances;
  for (const Bone& bone : scene.bones) distances.emplace_back(bone.surface);
  const PreparedTissue fibered = prepare_tissue(scene, scene.muscles[0], tube_fields(), distances);
  const Settled found = bent(radians(20));
  const std::vector<Real> tensions = fiber_tensions(fibered, laws, found.nodes);
  ASSERT_EQ(tensions.size(), 40U);
  Real sum = 0;
  for (const Real tension : tensions) sum += tension;
  EXPECT_NEAR(sum, mean_tension(fibered, laws, found.nodes), 0.03 * sum);
}

TEST(TissueForces, a_methods_forces_list_the_same_in_all_poses_and_pull_at_no_body_in_the_capture_pose) {
  const Scene scene = tube_scene();
  const auto method = make_tissue_method(scene, tube_fields());
  const auto forces_at = [&](Real angle) {
    return method->muscle_forces(joint_twists(scene, std::vector<Real>{angle}))[0];
  };
  const MuscleForces before = forces_at(0);
  method->advance(flexed(scene, radians(5)), usual_time_step);
  const MuscleForces after = forces_at(radians(5));
  EXPECT_EQ(before.tension, 0);
  EXPECT_GT(after.tension, 0);
  EXPECT_EQ(before.contact.size(), 2U);
  for (const auto list :
       {&MuscleForces::origin, &MuscleForces::insertion, &MuscleForces::fascia, &MuscleForces::contact}) {
    ASSERT_EQ((before.*list).size(), (after.*list).size());
    for (std::size_t i = 0; i < (before.*list).size(); ++i) {
      EXPECT_EQ((before.*list)[i].on, (after.*list)[i].on);
      EXPECT_LT((before.*list)[i].wrench.force.norm(), 1e-9);
    }
  }
}

TEST(TissueForces, far_from_the_origin_a_muscle_does_the_same) {
  Scene scene = tube_scene();
  // To rest: on the way there rounding of places grows.
  scene.method.settings = {{"minimizer_iterations", 3000}, {"minimizer_residual", 1e-9}};
  const Vec3 place(300, -200, 100);
  const auto near = make_tissue_method(scene, tube_fields());
  const auto far = placed_method(place, make_tissue_method(scene, tube_fields()));
  const Pose pose = flexed(scene, radians(5));
  near->advance(pose, usual_time_step);
  std::vector<std::vector<Twist>> twists = joint_twists(scene, pose.coordinates);
  Pose moved = pose;
  for (RigidTransform& body : moved.bodies) body.translation() += place - body.linear() * place;
  far->advance(moved, usual_time_step);
  const MuscleForces here = near->muscle_forces(twists)[0];
  for (std::vector<Twist>& bodies : twists)
    for (Twist& twist : bodies) twist.velocity = twist.velocity_at(-place);
  const MuscleForces there = far->muscle_forces(twists)[0];
  EXPECT_NEAR(there.moments[0], here.moments[0], 1e-6 * std::abs(here.moments[0]));
  const Wrench a = here.insertion[0].wrench, b = there.insertion[0].wrench;
  EXPECT_LT((b.moment - a.moment - place.cross(a.force)).norm(), 1e-6 * a.force.norm() * place.norm());
}

}  // namespace
}  // namespace gracilis
