#include "string_scenes.hpp"

#include <gracilis/strings/coupled_solver.hpp>
#include <gracilis/strings/cross_sections.hpp>
#include <gracilis/strings/force_rates.hpp>
#include <gracilis/strings/node_forces.hpp>
#include <gracilis/strings/relaxation.hpp>

#include <gtest/gtest.h>

namespace gracilis::strings {
namespace {

/// The arm's strings, bent and at rest.
struct Bent {
  Bent() : strung(arm_scene()), state(capture_state(strung.muscle, 2)) {
    follow(strung.muscle, strung.bones, flexed(strung.scene, radians(70)), state);
    settle(strung.muscle, strung.bones, state);
  }
  const MuscleStrings& muscle() const { return strung.muscle; }
  ForceRates rates() const { return {muscle(), strung.bones, state.places, state.bodies}; }
  bool is_free(Index p) const { return body_holding(muscle(), p / muscle().nodes, p % muscle().nodes) < 0; }

  Strung strung;
  StringState state;
};

const Bent& bent() {
  static const Bent made;
  return made;
}

Points random_columns(unsigned seed) {
  std::srand(seed);
  return Points::Random(3, bent().state.places.cols());
}

Points free_columns(Points columns) {
  for (Index p = 0; p < columns.cols(); ++p)
    if (!bent().is_free(p)) columns.col(p).setZero();
  return columns;
}

/// The forces that strings are relaxed by, at nodes that are free.
Points forces_at(const Points& places, const std::vector<RigidTransform>& bodies) {
  const MuscleStrings& muscle = bent().muscle();
  NodeForces forces(muscle, bent().strung.bones, bodies);
  forces.begin_iteration(places);
  Points all = Points::Zero(3, places.cols());
  StringSystem system(muscle.nodes);
  for (Index s = 0; s < muscle.strings; ++s) {
    forces.assemble(s, places, system);
    for (Index i = 1; i + 1 < muscle.nodes; ++i)
      all.col(muscle.node(s, i)) = system.gradient[static_cast<std::size_t>(i)];
  }
  return free_columns(all);
}

/// Fields are asked in single precision, which smaller steps feel; larger ones touch more bones on their way.
constexpr Real step = 1e-5;

/// The share of the free nodes at which two sets of forces differ by more than 5 % of their mean size: touching bones
/// or not, a node has another derivative to each side.
Real share_apart(const Points& found, const Points& expected) {
  Real size = 0, apart = 0, count = 0;
  for (Index p = 0; p < expected.cols(); ++p) size += expected.col(p).norm(), count += bent().is_free(p);
  for (Index p = 0; p < expected.cols(); ++p) apart += (found - expected).col(p).norm() > 0.05 * size / count;
  return apart / count;
}

TEST(ForceRates, by_places_are_the_derivative_of_the_forces) {
  const Points rates = random_columns(1);
  const Points& places = bent().state.places;
  const std::vector<RigidTransform>& bodies = bent().state.bodies;
  const Points expected =
      (forces_at(places + step * rates, bodies) - forces_at(places - step * rates, bodies)) / (2 * step);
  const Points found = bent().rates().by_places(rates);
  ASSERT_GT(expected.norm(), 1000);
  EXPECT_LT(share_apart(found, expected), 0.05);
}

TEST(ForceRates, by_bodies_are_the_derivative_of_the_forces) {
  const std::vector<Twist> twists = {{Vec3(0.1, -0.3, 0.2), Vec3(2, -1, 3)}, {Vec3(-0.2, 0.1, 0.3), Vec3(1, 3, -2)}};
  const auto moved = [&](Real by) {
    std::vector<RigidTransform> bodies = bent().state.bodies;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Vec3 turn = by * twists[b].turning;
      bodies[b] =
          Eigen::Translation3d(by * twists[b].velocity) * Eigen::AngleAxisd(turn.norm(), turn.normalized()) * bodies[b];
    }
    return bodies;
  };
  const Points& places = bent().state.places;
  const Points expected = (forces_at(places, moved(step)) - forces_at(places, moved(-step))) / (2 * step);
  ASSERT_GT(expected.norm(), 10);
  EXPECT_LT(share_apart(bent().rates().by_bodies(twists), expected), 0.05);
}

TEST(ForceRates, the_transposed_weighs_as_much) {
  const ForceRates rates = bent().rates();
  const Points weights = free_columns(random_columns(2)), moves = random_columns(3);
  EXPECT_NEAR(weights.cwiseProduct(rates.by_places(moves)).sum(),
              rates.by_places_transposed(weights).cwiseProduct(moves).sum(), 1e-8);
  const std::vector<Twist> twists = {{Vec3(0.1, -0.3, 0.2), Vec3(2, -1, 3)}, {Vec3(-0.2, 0.1, 0.3), Vec3(1, 3, -2)}};
  const Eigen::MatrixXd wrenches = rates.by_bodies_transposed(weights);
  Real work = 0;
  for (Index b = 0; b < 2; ++b)
    work += wrenches.col(b).head<3>().dot(twists[static_cast<std::size_t>(b)].velocity) +
            wrenches.col(b).tail<3>().dot(twists[static_cast<std::size_t>(b)].turning);
  EXPECT_NEAR(weights.cwiseProduct(rates.by_bodies(twists)).sum(), work, 1e-8);
}

TEST(ForceRates, a_motion_of_everything_changes_no_force_but_its_direction) {
  const ForceRates rates = bent().rates();
  const Twist all{Vec3(0.3, -0.2, 0.1), Vec3(1, 2, -1)};
  Points moves(3, bent().state.places.cols());
  for (Index p = 0; p < moves.cols(); ++p) moves.col(p) = all.velocity_at(bent().state.places.col(p));
  // At rest all forces are zero, and so are turned ones.
  EXPECT_LT((rates.by_places(moves) + rates.by_bodies({all, all})).norm(), 0.02);
}

TEST(SectionRates, are_the_derivative_of_the_turns) {
  const MuscleStrings& muscle = bent().muscle();
  const Points& places = bent().state.places;
  const Points rates = random_columns(4);
  const SectionRates sections(muscle, places);
  const Points turning = sections.turning(rates);
  constexpr Real small = 1e-6;
  const auto ahead = section_turns(muscle, places + small * rates),
             behind = section_turns(muscle, places - small * rates);
  for (Index i = 1; i + 1 < muscle.nodes; ++i) {
    const auto section = static_cast<std::size_t>(i);
    const Eigen::AngleAxisd turned(Eigen::Matrix3d(ahead[section] * behind[section].transpose()));
    EXPECT_LT((turned.axis() * turned.angle() / (2 * small) - turning.col(i)).norm(), 1e-4 * turning.col(i).norm());
  }
}

TEST(CoupledSolver, finds_the_moves_that_change_forces_so) {
  const ForceRates rates = bent().rates();
  const std::vector<char> none(static_cast<std::size_t>(bent().muscle().strings), 0);
  const CoupledSolver solver(bent().muscle(), rates, none);
  const Points moves = free_columns(random_columns(5)), forces = rates.by_places(moves);
  EXPECT_LT((solver.moves(forces) - moves).norm(), 1e-3 * moves.norm());
  const Points weights = free_columns(random_columns(6));
  const Points of_places = free_columns(rates.by_places_transposed(weights));
  EXPECT_LT((solver.transposed(of_places) - weights).norm(), 1e-3 * weights.norm());
}

}  // namespace
}  // namespace gracilis::strings
