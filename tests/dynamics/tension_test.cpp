#include <gracilis/dynamics/solver/solver.hpp>

#include <dynamics/systems_for_tests.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

constexpr Real segment_length = 0.01;  // m

/// A row of particles, the first one fixed, joined by segments that may contract.
SurfaceSystem chain(Index segments, Real stiffness, Real inverse_mass = 1e4) {
  Points x = Points::Zero(3, segments + 1);
  Eigen::VectorXd inverse_masses = Eigen::VectorXd::Constant(segments + 1, inverse_mass);
  inverse_masses[0] = 0;
  std::vector<DistanceConstraint> constraints;
  for (Index i = 0; i <= segments; ++i) x(0, i) = segment_length * i;
  for (Index i = 0; i < segments; ++i) constraints.push_back({i, i + 1, segment_length, 1 / stiffness});
  SurfaceSystem system;
  system.rest = make_particles(x, inverse_masses);
  system.tensions = build_distance_set(constraints, segments + 1);
  system.volume = build_volume_set(Eigen::Matrix3Xi(3, 0), segments + 1, 0, 0);
  return system;
}

SurfaceState aiming_at(const SurfaceSystem& system, float share) {
  SurfaceState state = make_state(system);
  for (float& length : state.tension_length) length *= share;
  return state;
}

SolveSettings active(int iterations, float strength = 1) {
  SolveSettings settings;
  settings.iterations = iterations;
  settings.tension.strength = strength;
  return settings;
}

std::vector<Real> lengths_of(const SurfaceState& state) {
  std::vector<Real> lengths;
  for (Index i = 1; i < state.particles.count(); ++i)
    lengths.push_back((state.particles.position(i) - state.particles.position(i - 1)).norm());
  return lengths;
}

}  // namespace

TEST(Tension, a_chain_that_nothing_resists_settles_at_the_length_it_aims_at) {
  const SurfaceSystem system = chain(12, 100);
  for (const float strength : {1.0f, 0.1f}) {
    SurfaceState state = aiming_at(system, 0.8f);
    for (int step = 0; step < 200; ++step) solve_substep(system, {}, active(30, strength), state);
    for (const Real length : lengths_of(state)) EXPECT_NEAR(length, 0.8 * segment_length, 1e-6);
  }
}

TEST(Tension, a_segment_shorter_than_it_aims_at_is_left_alone) {
  const SurfaceSystem system = chain(12, 100);
  SurfaceState state = aiming_at(system, 0.8f);
  for (Index i = 0; i <= 12; ++i) state.particles.position(i).x() *= 0.63f;
  const Points before = real_positions_of(state.particles);
  solve_substep(system, {}, active(30), state);
  EXPECT_EQ(real_positions_of(state.particles), before);
}

TEST(Tension, never_makes_a_segment_longer_whatever_its_neighbors_do) {
  const SurfaceSystem system = chain(20, 100);
  for (unsigned seed = 0; seed < 20; ++seed) {
    SurfaceState state = aiming_at(system, 0.9f);
    for (Index i = 1; i <= 20; ++i)
      state.particles.position(i).x() = state.particles.position(i - 1).x() + ((i + seed) % 3 == 0 ? 0.004f : 0.013f);
    for (int step = 0; step < 50; ++step) solve_substep(system, {}, active(30), state);
    for (const Real length : lengths_of(state)) EXPECT_LE(length, 0.9 * segment_length + 1e-6) << "pushed apart";
    for (const float multiplier : state.tension_lambda) EXPECT_LE(multiplier, 0) << "a push";
  }
}

TEST(Tension, two_sided_a_segment_is_held_at_the_length_it_aims_at_from_above_and_from_below) {
  const SurfaceSystem system = chain(1, 100);
  SolveSettings settings = active(30);
  settings.tension.two_sided = true;
  for (const float begin : {0.6f, 1.1f}) {
    SurfaceState state = aiming_at(system, 0.8f);
    state.particles.position(1).x() *= begin;
    for (int step = 0; step < 200; ++step) solve_substep(system, {}, settings, state);
    EXPECT_NEAR(lengths_of(state)[0], 0.8 * segment_length, 1e-6);
  }
}

TEST(Tension, two_sided_moves_as_an_edge_does) {
  SurfaceSystem system = chain(12, 100);
  SurfaceState tensions = aiming_at(system, 0.8f);
  for (Index i = 1; i <= 12; ++i) tensions.particles.position(i).x() *= i % 2 ? 0.9f : 0.7f;
  SolveSettings settings = active(30);
  settings.tension.two_sided = true;
  SurfaceState edges = tensions;
  solve_substep(system, {}, settings, tensions);
  std::swap(system.distances, system.tensions);
  std::swap(edges.target_length, edges.tension_length);
  std::swap(edges.distance_lambda, edges.tension_lambda);
  solve_substep(system, {}, settings, edges);
  EXPECT_LT((real_positions_of(tensions.particles) - real_positions_of(edges.particles)).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Tension, dissipates_as_rayleigh_says) {
  // One particle on a segment from a wall, predicted at p, that began its step at s: force k (L - x) - β (x - s) / dt
  // and inertia (x - p) / (w dt²) balance at x.
  const Real weight = 2, stiffness = 100, beta = 3, dt = 0.01, target = 0.8 * segment_length;
  const SurfaceSystem system = chain(1, stiffness, weight);
  for (const Real strength : {1.0, 0.5})
    for (const bool two_sided : {false, true}) {
      const Real start = 0.013, predicted = 0.011, k = strength * stiffness, b = strength * beta;
      SurfaceState state = aiming_at(system, 0.8f);
      state.start.position(1).x() = static_cast<float>(start);
      state.particles.position(1).x() = static_cast<float>(predicted);
      SolveSettings settings = active(200, static_cast<float>(strength));
      settings.tension.two_sided = two_sided;
      settings.projection.time_step = static_cast<float>(dt);
      settings.projection.rayleigh_beta = static_cast<float>(beta);
      solve_substep(system, {}, settings, state);
      const Real inertia = 1 / (weight * dt * dt);
      const Real pulled = (k * target + b / dt * start + inertia * predicted) / (k + b / dt + inertia);
      // At p the damper pushes more than the segment pulls: one that only pulls lets it be.
      ASSERT_GT(pulled, predicted);
      EXPECT_NEAR(lengths_of(state)[0], two_sided ? pulled : predicted, 1e-7);
    }
}

TEST(Tension, that_only_pulls_is_damped_while_it_does) {
  const Real weight = 2, stiffness = 100, beta = 0.2, dt = 0.01, target = 0.8 * segment_length;
  const SurfaceSystem system = chain(1, stiffness, weight);
  SurfaceState state = aiming_at(system, 0.8f);
  state.start.position(1).x() = 0.0095f;
  SolveSettings settings = active(200);
  settings.projection.time_step = static_cast<float>(dt);
  settings.projection.rayleigh_beta = static_cast<float>(beta);
  solve_substep(system, {}, settings, state);
  const Real inertia = 1 / (weight * dt * dt);
  EXPECT_NEAR(lengths_of(state)[0],
              (stiffness * target + beta / dt * 0.0095 + inertia * segment_length) / (stiffness + beta / dt + inertia),
              1e-7);
}

TEST(Tension, without_strength_nothing_moves) {
  const SurfaceSystem system = chain(12, 100);
  SurfaceState state = aiming_at(system, 0.7f);
  solve_substep(system, {}, active(30, 0), state);
  EXPECT_EQ(real_positions_of(state.particles), real_positions_of(system.rest));
}

TEST(Tension, against_a_spring_it_settles_where_both_pull_alike) {
  // So heavy that an iteration hardly moves it: both have their say before the next substep begins anew.
  // One segment of 100 N/m that aims at 7 mm beside a spring of 200 N/m that is 10 mm long at rest: at 9 mm both pull
  // with 0.2 N; at half the strength 50 (x - 7) = 200 (10 - x), x = 9.4 mm.
  SurfaceSystem system = chain(1, 100, 2);
  system.distances = build_distance_set({{0, 1, segment_length, 1.0 / 200}}, 2);
  for (const auto& [strength, length] : {std::pair{1.0f, 0.009}, {0.5f, 0.0094}}) {
    SurfaceState state = aiming_at(system, 0.7f);
    for (int step = 0; step < 2000; ++step) solve_substep(system, {}, active(30, strength), state);
    EXPECT_NEAR(lengths_of(state)[0], length, 1e-5);
  }
}

TEST(Tension, between_coinciding_ends_is_counted_and_stays_finite) {
  const SurfaceSystem system = chain(3, 100);
  SurfaceState state = aiming_at(system, 0.7f);
  for (Index i = 0; i <= 3; ++i) state.particles.position(i).setZero();
  EXPECT_EQ(solve_substep(system, {}, active(1), state).skipped_constraints, 3);
  EXPECT_TRUE(is_finite(state.particles));
}

TEST(Tension, keeps_the_volume_of_a_closed_surface_which_gets_thicker) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.03, 3);
  SystemOptions heavy;
  heavy.smallest_mass = 0.01;
  SurfaceSystem system = system_of(ball, heavy);
  std::vector<DistanceConstraint> meridians;
  const Points& x = ball.vertices;
  for (const MeshEdge& e : build_topology(ball.faces, ball.vertex_count()).edges) {
    const Vec3 d = x.col(e.b) - x.col(e.a), out = (x.col(e.a) + x.col(e.b)).normalized();
    const Vec3 to_pole = (Vec3::UnitZ() - out.z() * out).normalized();
    if (std::abs(d.dot(to_pole)) > 0.7 * d.norm()) meridians.push_back({e.a, e.b, d.norm(), 1.0 / 200});
  }
  system.tensions = build_distance_set(meridians, ball.vertex_count());
  SurfaceState state = aiming_at(system, 0.8f);
  for (int step = 0; step < 100; ++step) solve_substep(system, {}, active(30), state);
  const Points now = real_positions_of(state.particles);
  EXPECT_NEAR(enclosed_volume(now, ball.faces) / enclosed_volume(x, ball.faces), 1, 0.005);
  const auto extent = [](const Points& p, int axis) { return p.row(axis).maxCoeff() - p.row(axis).minCoeff(); };
  EXPECT_LT(extent(now, 2), 0.95 * extent(x, 2)) << "shorter";
  EXPECT_GT(extent(now, 0), 1.02 * extent(x, 0)) << "thicker";
}

}  // namespace gracilis
