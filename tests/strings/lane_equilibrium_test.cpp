#include "string_scenes.hpp"

#include <gracilis/strings/cross_sections.hpp>
#include <gracilis/strings/lane_equilibrium-inl.hpp>
#include <gracilis/strings/lane_pose-inl.hpp>
#include <gracilis/strings/node_forces.hpp>
#include <gracilis/strings/relaxation.hpp>

#include <gtest/gtest.h>

namespace gracilis::strings {
namespace {

using Equilibrium = HWY_NAMESPACE::LaneEquilibrium;
using HWY_NAMESPACE::LaneTwist;
using Numbers = std::vector<float>;

/// The arm's strings, bent and at rest, and the derivative of their forces.
struct Bent {
  Bent() : strung(arm_scene()), state(capture_state(strung.muscle, 2)) {
    follow(strung.muscle, strung.bones, flexed(strung.scene, radians(70)), state);
    settle(strung.muscle, strung.bones, state);
    HWY_NAMESPACE::LanePose(strung.muscle, strung.bones, state.bodies, workspace)
        .begin(lane_places(strung.muscle.lanes, state.places));
    equilibrium.emplace(strung.muscle, strung.bones, state.bodies, workspace, rates);
    equilibrium->differentiate();
  }
  const MuscleStrings& muscle() const { return strung.muscle; }
  bool is_free(Index p) const { return body_holding(muscle(), p / muscle().nodes, p % muscle().nodes) < 0; }

  Strung strung;
  StringState state;
  LaneWorkspace workspace;
  RateWorkspace rates;
  std::optional<Equilibrium> equilibrium;
};

Bent& bent() {
  static Bent made;
  return made;
}

std::size_t number_at(Index p, Index axis) {
  const MuscleStrings& muscle = bent().muscle();
  const auto lanes = static_cast<Index>(hwy::HWY_NAMESPACE::Lanes(HWY_NAMESPACE::D()));
  const Index s = p / muscle.nodes, i = p % muscle.nodes;
  return static_cast<std::size_t>(3 * (i * muscle.lanes.width + s / lanes * lanes) + axis * lanes + s % lanes);
}

Numbers in_lanes(const Points& columns) {
  Numbers numbers(static_cast<std::size_t>(3 * bent().muscle().lanes.width * bent().muscle().nodes), 0);
  for (Index p = 0; p < columns.cols(); ++p)
    for (Index axis = 0; axis < 3; ++axis) numbers[number_at(p, axis)] = static_cast<float>(columns(axis, p));
  return numbers;
}

Points from_lanes(const Numbers& numbers) {
  Points columns(3, bent().state.places.cols());
  for (Index p = 0; p < columns.cols(); ++p)
    for (Index axis = 0; axis < 3; ++axis) columns(axis, p) = static_cast<Real>(numbers[number_at(p, axis)]);
  return columns;
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

Points by_places(const Points& moves) { return from_lanes(bent().equilibrium->by_places(in_lanes(moves))); }
Points by_places_transposed(const Points& weights) {
  return from_lanes(bent().equilibrium->by_places_transposed(in_lanes(weights)));
}

const std::vector<Twist>& some_twists() {
  static const std::vector<Twist> twists = {{Vec3(0.1, -0.3, 0.2), Vec3(2, -1, 3)},
                                            {Vec3(-0.2, 0.1, 0.3), Vec3(1, 3, -2)}};
  return twists;
}

Points by_bodies(const std::vector<Twist>& twists) {
  std::vector<LaneTwist> seen;
  for (const Twist& twist : twists)
    seen.push_back({twist.velocity_at(bent().workspace.center).cast<float>(), twist.turning.cast<float>()});
  Numbers forces = in_lanes(Points::Zero(3, bent().state.places.cols()));
  bent().equilibrium->add_by_bodies(seen, forces);
  return from_lanes(forces);
}

/// The forces that strings are relaxed by in double precision, at nodes that are free.
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

TEST(LaneRates, hold_the_forces_that_strings_are_relaxed_by) {
  Points places = bent().state.places;
  const Points shift = free_columns(random_columns(7)) * 1e-3;
  StringState moved{places + shift, bent().state.bodies};
  LaneWorkspace workspace;
  RateWorkspace rates;
  HWY_NAMESPACE::LanePose(bent().muscle(), bent().strung.bones, moved.bodies, workspace)
      .begin(lane_places(bent().muscle().lanes, moved.places));
  Equilibrium(bent().muscle(), bent().strung.bones, moved.bodies, workspace, rates).differentiate();
  const Points expected = forces_at(moved.places, moved.bodies), found = free_columns(from_lanes(rates.force));
  ASSERT_GT(expected.norm(), 1);
  EXPECT_LT((found - expected).norm(), 1e-3 * expected.norm());
}

TEST(LaneRates, by_places_are_the_derivative_of_the_forces) {
  const Points rates = random_columns(1);
  const Points& places = bent().state.places;
  const std::vector<RigidTransform>& bodies = bent().state.bodies;
  const Points expected =
      (forces_at(places + step * rates, bodies) - forces_at(places - step * rates, bodies)) / (2 * step);
  ASSERT_GT(expected.norm(), 1000);
  EXPECT_LT(share_apart(by_places(rates), expected), 0.05);
}

TEST(LaneRates, by_bodies_are_the_derivative_of_the_forces) {
  const auto moved = [&](Real by) {
    std::vector<RigidTransform> bodies = bent().state.bodies;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Vec3 turn = by * some_twists()[b].turning;
      bodies[b] = Eigen::Translation3d(by * some_twists()[b].velocity) *
                  Eigen::AngleAxisd(turn.norm(), turn.normalized()) * bodies[b];
    }
    return bodies;
  };
  const Points& places = bent().state.places;
  const Points expected = (forces_at(places, moved(step)) - forces_at(places, moved(-step))) / (2 * step);
  ASSERT_GT(expected.norm(), 10);
  EXPECT_LT(share_apart(by_bodies(some_twists()), expected), 0.05);
}

TEST(LaneCoupling, sections_turn_as_the_derivative_of_their_turns_says) {
  const MuscleStrings& muscle = bent().muscle();
  const Points& places = bent().state.places;
  const Points rates = random_columns(4);
  const HWY_NAMESPACE::LaneCoupling coupling(muscle, bent().workspace, bent().rates);
  constexpr Real small = 1e-6;
  const auto ahead = section_turns(muscle, places + small * rates),
             behind = section_turns(muscle, places - small * rates);
  for (Index i = 1; i + 1 < muscle.nodes; ++i) {
    const auto section = static_cast<std::size_t>(i);
    const Eigen::AngleAxisd turned(Eigen::Matrix3d(ahead[section] * behind[section].transpose()));
    const Vec3 expected = turned.axis() * turned.angle() / (2 * small);
    const Vec3 found = coupling.section_turning(in_lanes(rates), section).cast<Real>();
    EXPECT_LT((found - expected).norm(), 1e-3 * expected.norm());
  }
}

TEST(LaneEquilibrium, the_transposed_weighs_as_much) {
  const Points weights = free_columns(random_columns(2)), moves = random_columns(3);
  // Single precision: sums of a thousand products of some 1000.
  const Real work = weights.cwiseProduct(by_places(moves)).sum();
  EXPECT_NEAR(work, by_places_transposed(weights).cwiseProduct(moves).sum(), 1e-5 * by_places(moves).norm());
  Real by_twists = 0;
  for (std::size_t b = 0; b < 2; ++b) {
    const auto [force, moment] = bent().equilibrium->on_body(b, in_lanes(weights));
    by_twists +=
        force.dot(some_twists()[b].velocity_at(bent().workspace.center)) + moment.dot(some_twists()[b].turning);
  }
  const Points forces = by_bodies(some_twists());
  EXPECT_NEAR(weights.cwiseProduct(forces).sum(), by_twists, 1e-5 * forces.norm());
}

TEST(LaneEquilibrium, a_motion_of_everything_changes_no_force_but_its_direction) {
  const Twist all{Vec3(0.3, -0.2, 0.1), Vec3(1, 2, -1)};
  Points moves(3, bent().state.places.cols());
  for (Index p = 0; p < moves.cols(); ++p) moves.col(p) = all.velocity_at(bent().state.places.col(p));
  // At rest all forces are zero, and so are turned ones.
  EXPECT_LT((by_places(moves) + by_bodies({all, all})).norm(), 0.02);
}

TEST(LaneEquilibrium, finds_the_moves_that_change_forces_so) {
  const Points moves = free_columns(random_columns(5));
  const Points found = from_lanes(bent().equilibrium->moves(in_lanes(by_places(moves)), 1e-4F));
  EXPECT_LT((found - moves).norm(), 1e-3 * moves.norm());
  const Points weights = free_columns(random_columns(6));
  const Points of_places = free_columns(by_places_transposed(weights));
  const Points weighed = from_lanes(bent().equilibrium->transposed(in_lanes(of_places), 1e-5F));
  EXPECT_LT((weighed - weights).norm(), 1e-3 * weights.norm());
}

}  // namespace
}  // namespace gracilis::strings
