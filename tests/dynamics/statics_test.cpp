#include <gracilis/dynamics/solver/solver.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

constexpr float gravity = 9.81f;

/// Masses (kg) hanging from a fixed point on a row of springs (N/m), 0.1 m each at rest.
SurfaceSystem hanging(const std::vector<Real>& masses, Real stiffness) {
  const auto count = static_cast<Index>(masses.size()) + 1;
  Points x = Points::Zero(3, count);
  Eigen::VectorXd inverse_masses = Eigen::VectorXd::Zero(count);
  std::vector<DistanceConstraint> springs;
  for (Index i = 1; i < count; ++i) {
    x(2, i) = -0.1 * i;
    inverse_masses[i] = 1 / masses[static_cast<std::size_t>(i) - 1];
    springs.push_back({i - 1, i, 0.1, 1 / stiffness});
  }
  SurfaceSystem system;
  system.rest = make_particles(x, inverse_masses);
  system.distances = build_distance_set(springs, count);
  system.volume = build_volume_set(Eigen::Matrix3Xi(3, 0), count, 0, 0);
  return system;
}

/// Lets the masses swing with damping until they hang still; returns how much each spring is longer than at rest.
std::vector<Real> extensions_at_rest(const SurfaceSystem& system, int iterations, float time_step) {
  SolveSettings settings;
  settings.iterations = iterations;
  settings.time_step = time_step;
  settings.projection.time_step = time_step;
  SurfaceState state = make_state(system);
  std::vector<Eigen::Vector3f> velocities(static_cast<std::size_t>(system.rest.count()), Eigen::Vector3f::Zero());
  for (int step = 0; step < 3000; ++step) {
    state.start = state.particles;
    for (Index i = 1; i < system.rest.count(); ++i) {
      Eigen::Vector3f& velocity = velocities[static_cast<std::size_t>(i)];
      velocity = 0.95f * velocity - time_step * gravity * Eigen::Vector3f::UnitZ();
      state.particles.position(i) += time_step * velocity;
    }
    solve_substep(system, {}, settings, state);
    for (Index i = 1; i < system.rest.count(); ++i)
      velocities[static_cast<std::size_t>(i)] = (state.particles.position(i) - state.start.position(i)) / time_step;
  }
  std::vector<Real> extensions;
  for (Index i = 1; i < system.rest.count(); ++i) {
    EXPECT_LT(velocities[static_cast<std::size_t>(i)].norm(), 1e-4) << "still swinging";
    extensions.push_back((state.particles.position(i) - state.particles.position(i - 1)).norm() - 0.1);
  }
  return extensions;
}

}  // namespace

TEST(Statics, a_hanging_mass_settles_at_its_weight_over_the_stiffness_whatever_the_iteration_count) {
  const SurfaceSystem system = hanging({0.5}, 100);
  for (float time_step : {1.0f / 60, 1.0f / 240})
    for (int iterations : {1, 3, 30})
      EXPECT_NEAR(extensions_at_rest(system, iterations, time_step).at(0), 0.5 * gravity / 100, 5e-6)
          << iterations << " iterations of " << time_step << " s";
}

TEST(Statics, every_spring_of_a_chain_carries_all_masses_below_it) {
  const std::vector<Real> extensions = extensions_at_rest(hanging({0.5, 0.2, 0.3}, 200), 100, 1.0f / 60);
  EXPECT_NEAR(extensions.at(0), 1.0 * gravity / 200, 5e-6);
  EXPECT_NEAR(extensions.at(1), 0.5 * gravity / 200, 5e-6);
  EXPECT_NEAR(extensions.at(2), 0.3 * gravity / 200, 5e-6);
}

}  // namespace gracilis
