#include <gracilis/methods/mass_spring/relaxation.hpp>
#include <gracilis/methods/mass_spring/spring_net.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace gracilis::mass_spring {
namespace {

Points random_points(Index count, Real size, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<Real> uniform(-size, size);
  Points points(3, count);
  for (Index i = 0; i < count; ++i) points.col(i) = Vec3(uniform(generator), uniform(generator), uniform(generator));
  return points;
}

Real energy(const SpringNet& net, const Points& points) {
  Real sum = 0;
  for (const Spring& spring : net.springs) {
    const Real change = (points.col(spring.a) - points.col(spring.b)).norm() - spring.length;
    sum += spring.stiffness * change * change / 2;
  }
  return sum;
}

/// Two particles 1 m apart on a spring of 3 N/m, drawn apart by 0.1 m in all; they weigh 2 kg each.
struct Pair {
  Points rest = Points(3, 2);
  SpringNet net;
  Motion motion;
  Real mass = 2, stiffness = 3;

  Pair() {
    rest << 0, 1, 0, 0, 0, 0;
    net = build_spring_net(rest, {{0, 1}}, stiffness, 0);
    motion.now = rest;
    motion.now(0, 0) -= 0.05;
    motion.now(0, 1) += 0.05;
    motion.before = motion.now;
  }
  Real stretch() const { return (motion.now.col(1) - motion.now.col(0)).norm() - 1; }
  void step(Real dt, Real damping, const std::vector<char>& fixed) {
    Points forces;
    spring_forces(net, motion.now, forces);
    verlet_step(forces, mass, damping, dt, fixed, motion);
  }
};

}  // namespace

TEST(MassSpringSprings, stiffness_is_the_material_over_the_rest_length) {
  Points rest(3, 3);
  rest << 0, 2, 2, 0, 0, 0.01, 0, 0, 0;
  const SpringNet net = build_spring_net(rest, {{0, 1}, {1, 2}}, 5, 0);
  EXPECT_NEAR(net.springs[0].stiffness, 2.5, 1e-12);
  EXPECT_NEAR(net.springs[1].stiffness, 500, 1e-9);
  EXPECT_NEAR(mean_stiffness(net), 251.25, 1e-9);
  const SpringNet limited = build_spring_net(rest, {{0, 1}, {1, 2}}, 5, 0.5);
  EXPECT_NEAR(limited.springs[1].stiffness, 5 / (0.5 * 1.005), 1e-9);
  EXPECT_NEAR(limited.springs[1].length, 0.01, 1e-12) << "its length at rest stays";
}

TEST(MassSpringSprings, forces_are_the_slope_of_the_energy_and_restore) {
  const Points rest = random_points(20, 1, 1), points = rest + random_points(20, 0.3, 2);
  const SpringNet net = build_spring_net(rest, nearest_pairs(rest, 5), 0.7, 0);
  Points forces;
  spring_forces(net, points, forces);
  constexpr Real h = 1e-6;
  for (Index p = 0; p < 20; ++p)
    for (int k = 0; k < 3; ++k) {
      Points after = points, before = points;
      after(k, p) += h;
      before(k, p) -= h;
      EXPECT_NEAR(forces(k, p), -(energy(net, after) - energy(net, before)) / (2 * h), 1e-7);
    }
  spring_forces(net, rest, forces);
  EXPECT_LT(forces.norm(), 1e-12);
}

TEST(MassSpringSprings, a_spring_without_length_pulls_nowhere) {
  const SpringNet net = build_spring_net(Points::Zero(3, 2), {{0, 1}}, 1, 0.3);
  Points forces;
  spring_forces(net, Points::Zero(3, 2), forces);
  EXPECT_EQ(forces.norm(), 0);
}

TEST(MassSpringSprings, length_changes_sum_over_all_springs) {
  Points rest(3, 3), now(3, 3);
  rest << 0, 1, 2, 0, 0, 0, 0, 0, 0;
  now << 0, 1.5, 2, 0, 0, 0, 0, 0, 0;
  EXPECT_NEAR(length_changes(build_spring_net(rest, {{0, 1}, {1, 2}}, 1, 0), now), 1, 1e-12);
}

TEST(MassSpringSprings, without_fixed_particles_and_damping_momentum_stays) {
  const Points rest = random_points(60, 0.05, 3);
  const SpringNet net = build_spring_net(rest, nearest_pairs(rest, 10), 0.001, 0.3);
  const std::vector<char> all_free(60, 0);
  Motion motion{rest + random_points(60, 0.01, 4), rest + random_points(60, 0.01, 4)};
  motion.now += random_points(60, 0.002, 5);
  const Vec3 momentum = (motion.now - motion.before).rowwise().sum();
  ASSERT_GT(momentum.norm(), 1e-4);
  const Real speed = (motion.now - motion.before).colwise().norm().sum();
  for (int i = 0; i < 500; ++i) {
    Points forces;
    spring_forces(net, motion.now, forces);
    verlet_step(forces, 1, 0, 0.1, all_free, motion);
    EXPECT_LT(((motion.now - motion.before).rowwise().sum() - momentum).norm(), 1e-10 * speed);
  }
}

TEST(MassSpringSprings, two_free_particles_swing_with_the_period_of_their_spring) {
  Pair pair;
  const Real expected = 2 * pi * std::sqrt(pair.mass / (2 * pair.stiffness)), dt = expected / 1000;
  std::vector<Real> crossings;
  Real before = pair.stretch();
  for (int i = 1; i <= 10500; ++i) {
    pair.step(dt, 0, {0, 0});
    const Real now = pair.stretch();
    if (before > 0 && now <= 0) crossings.push_back(dt * (i - 1 + before / (before - now)));
    before = now;
  }
  ASSERT_GE(crossings.size(), 10u);
  const Real period = (crossings.back() - crossings.front()) / static_cast<Real>(crossings.size() - 1);
  EXPECT_NEAR(period / expected, 1, 0.01);
}

TEST(MassSpringSprings, critical_damping_comes_to_rest_without_overshooting_and_less_overshoots) {
  const auto least_stretch = [](Real share) {
    Pair pair;
    const Real damping = share * critical_damping(pair.stiffness, pair.mass);
    Real least = pair.stretch();
    for (int i = 0; i < 20000; ++i) {
      pair.step(0.001, damping, {1, 0});
      least = std::min(least, pair.stretch());
    }
    EXPECT_NEAR(pair.stretch(), 0, 1e-5) << "at rest in the end";
    return least;
  };
  EXPECT_GT(least_stretch(1), -1e-9);
  EXPECT_LT(least_stretch(0.7), -1e-3);
}

TEST(MassSpringSprings, damping_never_turns_a_velocity_round) {
  Pair pair;
  pair.motion.now = pair.rest;
  pair.motion.before = pair.rest;
  pair.motion.before.col(1).x() -= 0.1;
  const Real before = pair.motion.now(0, 1);
  pair.step(1, 1000, {1, 0});
  EXPECT_EQ(pair.motion.now(0, 1), before);
}

TEST(MassSpringSprings, damping_rules_are_the_published_ones) {
  EXPECT_NEAR(critical_damping(3, 2), std::sqrt(24.0), 1e-12);
  EXPECT_NEAR(fitted_damping(0.5, 2), std::sqrt(4.0 * 10 * 4), 1e-12);
  Pair pair;
  MassSpringSettings settings;
  settings.particle_mass = 2;
  EXPECT_NEAR(damping_of(settings, pair.net), std::sqrt(24.0), 1e-12);
  settings.damping_rule = DampingRule::fitted;
  EXPECT_NEAR(damping_of(settings, pair.net), fitted_damping(3, 2), 1e-12);
  settings.damping_rule = DampingRule::none;
  EXPECT_EQ(damping_of(settings, pair.net), 0);
}

TEST(MassSpringSprings, the_longest_step_moves_a_particle_by_its_radius_at_most) {
  const Real mass = 2, damping = 0.5;
  for (const Real force : {0.0, 0.3, 40.0})
    for (const Real moved : {0.0, 0.004, 0.0099}) {
      const Real radius = 0.01, step = longest_step(force, moved, radius, mass, damping);
      if (force == 0 && moved == 0) {
        EXPECT_TRUE(std::isinf(step));
        continue;
      }
      EXPECT_NEAR(force * step * step + damping * moved * step + mass * (moved - radius), 0, 1e-12);
      // Against the damping, the worst direction: force and motion along each other.
      const Vec3 along = Vec3::UnitX();
      Motion motion{moved * along, Vec3::Zero()};
      const Vec3 start = motion.now.col(0);
      verlet_step(Points(force * along), mass, damping, step, {0}, motion);
      EXPECT_LE((motion.now.col(0) - start).norm(), radius * (1 + 1e-9));
    }
  EXPECT_EQ(longest_step(1, 0.01, 0.01, mass, damping), 0) << "no step is short enough";
}

TEST(MassSpringSprings, within_the_stable_step_energy_stays_bounded_and_beyond_it_may_not) {
  const Points rest = random_points(40, 0.05, 6);
  const SpringNet net = build_spring_net(rest, nearest_pairs(rest, 8), 0.001, 0.3);
  const auto energy_after = [&](Real step) {
    Motion motion{rest + random_points(40, 0.001, 7), {}};
    motion.before = motion.now;
    Points forces;
    for (int i = 0; i < 2000; ++i) {
      spring_forces(net, motion.now, forces);
      verlet_step(forces, 1, 0, step, std::vector<char>(40, 0), motion);
    }
    return energy(net, motion.now) / energy(net, rest + random_points(40, 0.001, 7));
  };
  const Real step = stable_step(net, 1);
  EXPECT_LT(energy_after(step), 4);
  EXPECT_FALSE(energy_after(3 * step) < 4) << "or not even finite";
}

TEST(MassSpringSprings, relaxing_ends_by_count_by_mean_motion_or_by_time) {
  Pair pair;
  const std::vector<char> fixed = {1, 0};
  const std::vector<Real> radii = {0, 0};
  const auto run = [&](RelaxationRule rule) {
    std::vector<RelaxedMuscle> muscles = {
        {&pair.net, &fixed, &radii, pair.mass, critical_damping(pair.stiffness, pair.mass), pair.motion}};
    rule.step = 0.05;
    return relax(muscles, rule, [] {});
  };
  EXPECT_EQ(run({.iterations = 37}).iterations, 37);
  const int still = run({.iterations = 10000, .stop_displacement = 1e-6}).iterations;
  EXPECT_GT(still, 20);
  EXPECT_LT(still, 1000);
  const int timed = run({.iterations = 100000000, .stop_milliseconds = 20}).iterations;
  EXPECT_GT(timed, 0);
  EXPECT_LT(timed, 100000000);
}

TEST(MassSpringSprings, adaptive_steps_are_between_their_bounds_and_the_same_for_all) {
  Pair pair;
  const std::vector<char> fixed = {1, 0};
  const auto mean_step = [&](Real radius) {
    const std::vector<Real> radii = {radius, radius};
    std::vector<RelaxedMuscle> muscles(2, {&pair.net, &fixed, &radii, pair.mass, 0.1, pair.motion});
    RelaxationRule rule{.iterations = 50, .step = 0.4, .smallest_step = 0.04};
    return relax(muscles, rule, [] {}).mean_step;
  };
  EXPECT_NEAR(mean_step(1e-6), 0.04, 1e-9) << "tiny spheres, least steps";
  EXPECT_NEAR(mean_step(100), 0.4, 1e-9);
  EXPECT_GT(mean_step(0.02), 0.041);
  EXPECT_LT(mean_step(0.02), 0.399);
}

}  // namespace gracilis::mass_spring
