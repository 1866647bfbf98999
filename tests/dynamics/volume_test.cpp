#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/constraints/volume.hpp>

#include "systems_for_tests.hpp"

#include <gtest/gtest.h>

namespace gracilis {
namespace {

const TriangleMesh& fine_ball() {
  static const TriangleMesh mesh = shapes::sphere({0.01, -0.02, 0.005}, 0.03, 4);
  return mesh;
}

Real volume_of(const Particles& particles) { return enclosed_volume(real_positions_of(particles), fine_ball().faces); }

}  // namespace

TEST(VolumeProjection, restores_the_volume_of_a_scaled_sphere) {
  const SurfaceSystem system = system_of(fine_ball());
  for (float scale : {0.7f, 0.95f, 1.3f}) {
    SurfaceState state = make_state(system);
    for (Index i = 0; i < state.particles.count(); ++i) state.particles.position(i) *= scale;
    EXPECT_GT(std::abs(volume_of(state.particles) / system.volume.target - 1), 0.1);
    for (int i = 0; i < 8; ++i)
      project_volume(system.volume, 1.0 / 60, 1, state.volume_lambda, state.volume_gradients, state.particles);
    EXPECT_NEAR(volume_of(state.particles) / system.volume.target, 1, 1e-6) << scale;
  }
}

TEST(VolumeProjection, aims_at_the_pressure_times_the_volume_at_rest) {
  const SurfaceSystem system = system_of(fine_ball());
  SurfaceState state = make_state(system);
  for (int i = 0; i < 8; ++i)
    project_volume(system.volume, 1.0 / 60, 1.25, state.volume_lambda, state.volume_gradients, state.particles);
  EXPECT_NEAR(volume_of(state.particles) / system.volume.target, 1.25, 1e-6);
}

TEST(VolumeProjection, answers_with_the_volume_before) {
  const SurfaceSystem system = system_of(fine_ball());
  SurfaceState state = make_state(system);
  shake(state.particles, 0.001f, 4);
  const Real before = volume_of(state.particles);
  const double answer =
      project_volume(system.volume, 1.0 / 60, 1.1, state.volume_lambda, state.volume_gradients, state.particles);
  EXPECT_NEAR(answer / before, 1, 1e-6);
}

TEST(VolumeProjection, gradient_is_that_of_the_volume) {
  const SurfaceSystem system = system_of(fine_ball());
  SurfaceState state = make_state(system);
  shake(state.particles, 0.0005f, 4);
  Points x = real_positions_of(state.particles);
  project_volume(system.volume, 1.0 / 60, 1, state.volume_lambda, state.volume_gradients, state.particles);
  const Real scale = 0.001 * 0.001;  // an edge's length squared
  for (Index i = 0; i < x.cols(); i += 97)
    for (int axis = 0; axis < 3; ++axis) {
      const Real there = x(axis, i);
      x(axis, i) = there + 1e-5;
      const Real above = enclosed_volume(x, fine_ball().faces);
      x(axis, i) = there - 1e-5;
      const Real below = enclosed_volume(x, fine_ball().faces);
      x(axis, i) = there;
      EXPECT_NEAR(state.volume_gradients[static_cast<std::size_t>(4 * i + axis)], (above - below) / 2e-5, 1e-5 * scale);
    }
}

TEST(VolumeProjection, with_compliance_settles_where_the_pressure_balances) {
  SurfaceSystem system = system_of(fine_ball());
  system.volume.compliance = 1e-12;
  SurfaceState state = make_state(system);
  for (Index i = 0; i < state.particles.count(); ++i) state.particles.position(i) *= 0.9f;
  for (int i = 0; i < 50; ++i)
    project_volume(system.volume, 1.0 / 60, 1, state.volume_lambda, state.volume_gradients, state.particles);
  const Real missing = system.volume.target - volume_of(state.particles);
  EXPECT_GT(missing, 0);
  EXPECT_NEAR(state.volume_lambda * system.volume.compliance * 3600, missing,
              1e-5 * missing + 1e-6 * system.volume.target);
}

TEST(VolumeProjection, with_everything_fixed_moves_nothing) {
  SurfaceSystem system = system_of(fine_ball());
  for (Index i = 0; i < system.rest.count(); ++i) system.rest.at(i)[3] = 0;
  SurfaceState state = make_state(system);
  project_volume(system.volume, 1.0 / 60, 2, state.volume_lambda, state.volume_gradients, state.particles);
  EXPECT_EQ(state.particles.xyzw, system.rest.xyzw);
}

}  // namespace gracilis
