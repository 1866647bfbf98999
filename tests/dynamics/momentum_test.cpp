#include <gracilis/dynamics/constraints/strain_limit.hpp>

#include "systems_for_tests.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace gracilis {
namespace {

/// What one projection of constraints that share no particle adds to linear and angular momentum, as shares of the sum
/// of all momenta.
struct Gain {
  Real linear, angular;
};

Gain gain_of(const Particles& before, const Particles& after) {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  Real scale = 0, angular_scale = 0;
  for (Index i = 0; i < before.count(); ++i) {
    const Vec3 x = before.position(i).cast<Real>();
    const Vec3 momentum = (after.position(i).cast<Real>() - x) / before.inverse_mass(i);
    linear += momentum;
    angular += x.cross(momentum);
    scale += momentum.norm();
    angular_scale += x.norm() * momentum.norm();
  }
  EXPECT_GT(scale, 0);
  return {linear.norm() / scale, angular.norm() / angular_scale};
}

void expect_no_gain(Particles& particles, const std::function<void()>& project) {
  const Particles before = particles;
  project();
  const Gain gain = gain_of(before, particles);
  EXPECT_LT(gain.linear, 1e-5);
  EXPECT_LT(gain.angular, 1e-5);
}

SurfaceState shaken(const SurfaceSystem& system) {
  SurfaceState state = make_state(system);
  shake(state.particles, 0.002f, 8);
  return state;
}

}  // namespace

TEST(Momentum, is_kept_by_distances) {
  const SurfaceSystem system = system_of(off_center_ball());
  SurfaceState state = shaken(system);
  for (const ColorRange& color : system.distances.order.colors)
    expect_no_gain(state.particles, [&] {
      project_distances(system.distances, color, state.target_length.data(), state.distance_lambda.data(), state.start,
                        state.particles, {});
    });
}

TEST(Momentum, is_kept_by_dihedrals_with_and_without_their_limit) {
  const SurfaceSystem system = system_of(off_center_ball());
  for (float limit : {0.0f, 0.05f})
    for (bool arccos : {false, true}) {
      ProjectionParameters parameters;
      parameters.dihedral_limit = limit;
      parameters.arccos_dihedrals = arccos;
      SurfaceState state = shaken(system);
      for (const ColorRange& color : system.dihedrals.order.colors)
        expect_no_gain(state.particles, [&] {
          project_dihedrals(system.dihedrals, color, state.dihedral_lambda.data(), state.start, state.particles,
                            parameters);
        });
    }
}

TEST(Momentum, is_kept_by_the_strain_limit) {
  const SurfaceSystem system = system_of(off_center_ball());
  SurfaceState state = shaken(system);
  Index limited = 0;
  for (const ColorRange& color : system.distances.order.colors)
    expect_no_gain(state.particles,
                   [&] { limited += project_strain_limit(system.distances, color, 1.01f, state.particles); });
  EXPECT_GT(limited, 100);
}

TEST(Momentum, is_kept_by_the_volume) {
  const SurfaceSystem system = system_of(off_center_ball());
  SurfaceState state = shaken(system);
  expect_no_gain(state.particles, [&] {
    project_volume(system.volume, 1.0 / 60, 1.2, state.volume_lambda, state.volume_gradients, state.particles);
  });
}

}  // namespace gracilis
