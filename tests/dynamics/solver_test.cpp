#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/solver/solver.hpp>

#include <gracilis/core/state_hash.hpp>

#include "systems_for_tests.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

namespace gracilis {
namespace {

/// A soft ball, large enough to be cut into many tasks, pressed into a hard one.
struct Pressed {
  DistanceField obstacle;
  SurfaceSystem system;
};

const Pressed& pressed() {
  static const Pressed scene = [] {
    Pressed p;
    const TriangleMesh hard = shapes::sphere(Vec3::Zero(), 0.02, 4);
    p.obstacle = build_distance_field(hard, domain_by_cell_size(hard, 0.001, 0.012));
    const TriangleMesh soft = shapes::sphere({0, 0, 0.045}, 0.03, 6);
    p.system = system_of(soft);
    FieldContactSet contact;
    contact.field = bounded(p.obstacle);
    contact.captured.particle.assign(static_cast<std::size_t>(soft.vertex_count()), 0.0003f);
    contact.captured.edge_sag.assign(p.system.distances.a.size(), 0);
    contact.released = contact.captured;
    p.system.contacts.push_back(std::move(contact));
    return p;
  }();
  return scene;
}

SolveSettings usual(int iterations) {
  SolveSettings settings;
  settings.iterations = iterations;
  settings.projection.dihedral_limit = 0.05f;
  settings.strain_limit = 1.5f;
  return settings;
}

}  // namespace

TEST(Solver, gives_the_same_bits_for_any_number_of_threads) {
  std::vector<std::uint64_t> hashes;
  for (int threads : {1, 2, 64}) {
    const ThreadLimit limit(threads);
    SurfaceState state = make_state(pressed().system);
    shake(state.particles, 0.0003f, 9);
    const SolveReport report = solve_substep(pressed().system, {FieldPlacement{}}, usual(10), state);
    EXPECT_GT(report.contacts, 50);
    std::uint64_t hash = hash_of(state.particles.xyzw);
    hash = hash_of(state.distance_lambda, hash);
    hash = hash_of(state.dihedral_lambda, hash);
    hash = hash_bytes(&state.volume_lambda, sizeof state.volume_lambda, hash);
    hashes.push_back(hash);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(SurfaceState, begins_at_rest_with_multipliers_of_zero_to_which_a_reset_returns) {
  SurfaceSystem system = system_of(off_center_ball());
  SurfaceState state = make_state(system);
  EXPECT_EQ(state.particles.xyzw, system.rest.xyzw);
  EXPECT_EQ(state.start.xyzw, system.rest.xyzw);
  EXPECT_EQ(state.velocities, decltype(state.velocities)(3 * static_cast<std::size_t>(system.rest.count()), 0));
  EXPECT_EQ(state.volume, system.volume.target);
  const SurfaceState fresh = state;
  for (AlignedVector<float>* multipliers : {&state.distance_lambda, &state.tension_lambda, &state.dihedral_lambda}) {
    multipliers->resize(multipliers->size() + 3);
    for (float& each : *multipliers) each = 7;
  }
  state.volume_lambda = 7;
  reset_multipliers(state);
  for (const AlignedVector<float>* multipliers :
       {&state.distance_lambda, &state.tension_lambda, &state.dihedral_lambda}) {
    EXPECT_GE(multipliers->size(), 3u);
    for (const float each : *multipliers) EXPECT_EQ(each, 0);
  }
  EXPECT_EQ(state.volume_lambda, 0);
  for (const float each : fresh.distance_lambda) EXPECT_EQ(each, 0);
  for (const float each : fresh.dihedral_lambda) EXPECT_EQ(each, 0);
}

TEST(Solver, at_rest_stays_at_rest) {
  SurfaceSystem system = pressed().system;
  system.contacts.clear();
  SurfaceState state = make_state(system);
  for (int i = 0; i < 5; ++i) solve_substep(system, {}, usual(30), state);
  EXPECT_LT((real_positions_of(state.particles) - real_positions_of(system.rest)).colwise().norm().maxCoeff(), 1e-6);
}

TEST(Solver, ends_outside_of_the_obstacle_with_its_volume) {
  SurfaceState state = make_state(pressed().system);
  solve_substep(pressed().system, {FieldPlacement{}}, usual(60), state);
  for (Index i = 0; i < state.particles.count(); ++i) EXPECT_GT(state.particles.position(i).norm(), 0.02f);
  EXPECT_NEAR(state.volume / pressed().system.volume.target, 1, 0.005);
}

TEST(Solver, stops_early_when_nothing_moves_any_more) {
  SurfaceSystem system = pressed().system;
  system.contacts.clear();
  SurfaceState state = make_state(system);
  SolveSettings settings = usual(50);
  settings.stop_displacement = 1e-6f;
  EXPECT_LT(solve_substep(system, {}, settings, state).iterations, 3);
  shake(state.particles, 0.0003f, 2);
  EXPECT_GT(solve_substep(system, {}, settings, state).iterations, 3);
}

TEST(Solver, stops_early_when_its_time_is_over_but_solves_once) {
  SurfaceState state = make_state(pressed().system);
  SolveSettings settings = usual(100000);
  settings.stop_milliseconds = 1e-6;
  EXPECT_EQ(solve_substep(pressed().system, {FieldPlacement{}}, settings, state).iterations, 1);
}

TEST(Solver, survives_coinciding_ends_and_counts_them) {
  SurfaceSystem system = system_of(shapes::sphere(Vec3::Zero(), 0.03, 3));
  SurfaceState state = make_state(system);
  const Index a = system.distances.a.at(0), b = system.distances.b.at(0);
  state.particles.position(b) = state.particles.position(a);
  const SolveReport report = solve_substep(system, {}, usual(1), state);
  EXPECT_GE(report.skipped_constraints, 1);
  EXPECT_TRUE(is_finite(state.particles));
}

TEST(Solver, everything_on_one_point_stays_finite) {
  SurfaceSystem system = system_of(shapes::sphere(Vec3::Zero(), 0.03, 3));
  SurfaceState state = make_state(system);
  for (Index i = 0; i < state.particles.count(); ++i) state.particles.position(i).setZero();
  const SolveReport report = solve_substep(system, {}, usual(5), state);
  EXPECT_TRUE(is_finite(state.particles));
  EXPECT_GE(report.skipped_constraints, system.distances.count + system.dihedrals.count);
}

TEST(Solver, knows_a_coordinate_that_is_not_finite) {
  SurfaceState state = make_state(pressed().system);
  EXPECT_TRUE(is_finite(state.particles));
  state.particles.position(7).y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(is_finite(state.particles));
  state.particles.position(7).y() = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(is_finite(state.particles));
}

TEST(Solver, limits_the_stretch_of_what_untangling_moved_though_no_edge_came_near_the_limit_before) {
  const SurfaceSystem system = system_of(shapes::sphere(Vec3::Zero(), 0.03, 3));
  const auto longest = [&](const Particles& particles) {
    float ratio = 0;
    for (const Index slot : system.distances.slot) {
      const auto at = static_cast<std::size_t>(slot);
      const float length =
          (particles.position(system.distances.b[at]) - particles.position(system.distances.a[at])).norm();
      ratio = std::max(ratio, length / system.distances.rest_length[at]);
    }
    return ratio;
  };
  SurfaceState state = make_state(system);
  SolveSettings settings = usual(3);
  settings.settling_rounds = 4;
  const std::vector<FieldPlacement> nowhere;
  std::vector<SurfaceSolve> alone = {{&system, &nowhere, settings, &state, {}}};
  Coupling coupling;
  coupling.refresh = [](const Movers&) {};
  coupling.project = [](const Movers&) { return Index{0}; };
  bool is_untangled = false;
  coupling.find_tangles = [&](const Movers&) {
    return std::vector<Tangle>{is_untangled ? Tangle{} : Tangle{{{0, 1}}, 1}};
  };
  coupling.untangle = [&](const std::vector<Tangle>&, int) {
    is_untangled = true;
    state.particles.position(7) *= 1.5f;
    EXPECT_GT(longest(state.particles), 2);
  };
  solve_together(alone, coupling);
  EXPECT_LT(longest(state.particles), 1.01f * settings.strain_limit);
}

namespace {

/// Two balls of which the second is tangled, with so many cuts before each look at it; untangling moves its particle 7.
struct TangledBall {
  explicit TangledBall(std::vector<std::size_t> cuts_) : cuts(std::move(cuts_)) {
    settings.settling_rounds = 4;
    coupling.refresh = [](const Movers&) {};
    coupling.project = [](const Movers&) { return Index{0}; };
    coupling.find_tangles = [this](const Movers&) {
      places.push_back(states[1].particles.position(7));
      return std::vector<Tangle>{{}, {std::vector<FacePair>(cuts[looks], FacePair{0, 1}), cuts[looks++]}};
    };
    coupling.untangle = [this](const std::vector<Tangle>& tangles, int attempt) {
      EXPECT_EQ(attempt, untangled++);
      // The first attempt's stay, and of later ones the best.
      EXPECT_EQ(tangles[1].cuts, looks == 1 ? cuts[0] : *std::min_element(&cuts[1], &cuts[looks]));
      states[1].particles.position(7) *= 1.02f;
    };
  }
  void solve() {
    std::vector<SurfaceSolve> both;
    for (SurfaceState& state : states) both.push_back({&system, &nowhere, settings, &state, {}});
    solve_together(both, coupling, [this](std::size_t surface, ConstraintKind kind) {
      if (untangled > 0 && kind == ConstraintKind::volume) ++settled[surface];
    });
  }

  std::vector<std::size_t> cuts;
  SurfaceSystem system = system_of(shapes::sphere(Vec3::Zero(), 0.03, 3));
  std::vector<SurfaceState> states = std::vector<SurfaceState>(2, make_state(system));
  std::vector<FieldPlacement> nowhere;
  SolveSettings settings = usual(3);
  Coupling coupling;
  std::vector<Eigen::Vector3f> places;  ///< of the particle, at each look
  std::size_t looks = 0;
  int untangled = 0;
  int settled[2] = {0, 0};
};

}  // namespace

TEST(Solver, all_settle_with_what_was_untangled_and_what_is_untangled_again_settles_alone) {
  TangledBall ball({4, 3, 2, 1});
  ball.solve();
  EXPECT_EQ(ball.settled[0], ball.settings.settling_rounds);
  EXPECT_EQ(ball.settled[1], 3 * ball.settings.settling_rounds);
  EXPECT_EQ(ball.untangled, 3) << "what still cuts itself is left";
}

TEST(Solver, what_is_tangled_no_less_by_a_further_attempt_is_where_it_was_before) {
  TangledBall better({3, 2, 1, 1}), same({3, 2, 2, 2}), worse({1, 2, 7, 3}), late({1, 2, 7, 1});
  for (const auto& [ball, look] : {std::pair{&better, 2u}, {&same, 1u}, {&worse, 1u}, {&late, 3u}}) {
    ball->solve();
    ASSERT_EQ(ball->looks, 4u);
    ASSERT_NE(ball->places[2], ball->places[1]);
    EXPECT_EQ(ball->states[1].particles.position(7), ball->places[look]);
  }
}

}  // namespace gracilis
