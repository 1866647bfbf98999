#include <gracilis/dynamics/constraints/strain_limit.hpp>
#include <gracilis/dynamics/constraints/volume.hpp>

#include "reference_projection.hpp"
#include "systems_for_tests.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {
namespace {

/// A shaken system with multipliers under way, some particles fixed.
struct ShakenSystem {
  SurfaceSystem system;
  SurfaceState state;
};

ShakenSystem shaken(unsigned seed) {
  SystemOptions options;
  options.fixed_share = 0.1;
  options.seed = seed;
  ShakenSystem scenario{system_of(off_center_ball(), options), {}};
  scenario.state = make_state(scenario.system);
  shake(scenario.state.start, 0.0002f, seed + 1);
  shake(scenario.state.particles, 0.0008f, seed + 2);
  std::mt19937 generator(seed + 3);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (Index slot : scenario.system.distances.slot)
    scenario.state.distance_lambda[static_cast<std::size_t>(slot)] = 1e-6f * uniform(generator);
  for (Index slot : slots_of(scenario.system.dihedrals))
    scenario.state.dihedral_lambda[static_cast<std::size_t>(slot)] = 1e-9f * uniform(generator);
  return scenario;
}

Real farthest(const Points& from, const Points& to) { return (to - from).colwise().norm().maxCoeff(); }

/// Largest deviation of the vectorised result from the reference, as a share of the largest motion.
Real deviation(const Points& before, const Particles& after, const Points& expected) {
  EXPECT_GT(farthest(before, expected), 1e-5) << "nothing moved";
  return farthest(real_positions_of(after), expected) / farthest(before, expected);
}

Real lambda_deviation(const AlignedVector<float>& lambda, const std::vector<Real>& expected) {
  Real worst = 0, scale = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    worst = std::max(worst, std::abs(static_cast<Real>(lambda[i]) - expected[i]));
    scale = std::max(scale, std::abs(expected[i]));
  }
  return worst / scale;
}

std::vector<ProjectionParameters> parameter_sets() {
  ProjectionParameters plain, dissipative, limited;
  dissipative.rayleigh_beta = 0.5f;
  limited.dihedral_limit = 0.05f;
  return {plain, dissipative, limited};
}

}  // namespace

TEST(DistanceProjection, agrees_with_plain_double_precision) {
  for (const ProjectionParameters& parameters : parameter_sets()) {
    ShakenSystem scenario = shaken(11);
    SurfaceState& state = scenario.state;
    for (float& target : state.target_length) target *= 0.95f;
    const Points before = real_positions_of(state.particles);
    reference::State expected = reference::state_of(state.particles, state.start, state.distance_lambda);
    reference::project_distances(scenario.system.distances, state.target_length, expected, parameters);
    for (const ColorRange& color : scenario.system.distances.order.colors)
      project_distances(scenario.system.distances, color, state.target_length.data(), state.distance_lambda.data(),
                        state.start, state.particles, parameters);
    EXPECT_LT(deviation(before, state.particles, expected.x), 1e-5);
    EXPECT_LT(lambda_deviation(state.distance_lambda, expected.lambda), 1e-5);
  }
}

TEST(DihedralProjection, agrees_with_plain_double_precision) {
  for (const ProjectionParameters& parameters : parameter_sets()) {
    ShakenSystem scenario = shaken(12);
    SurfaceState& state = scenario.state;
    const Points before = real_positions_of(state.particles);
    reference::State expected = reference::state_of(state.particles, state.start, state.dihedral_lambda);
    reference::project_dihedrals(scenario.system.dihedrals, expected, parameters);
    for (const ColorRange& color : scenario.system.dihedrals.order.colors)
      project_dihedrals(scenario.system.dihedrals, color, state.dihedral_lambda.data(), state.start, state.particles,
                        parameters);
    EXPECT_LT(deviation(before, state.particles, expected.x), 1e-5);
    EXPECT_LT(lambda_deviation(state.dihedral_lambda, expected.lambda), 1e-5);
  }
}

namespace {

/// Two triangles folded by `angle` that want to be flat.
ShakenSystem one_dihedral(Real angle, Real compliance) {
  Points x(3, 4);
  x.col(0) = Vec3::Zero(), x.col(1) = Vec3(0.004, 0, 0);
  x.col(2) = Vec3(0.002, 0.003, 0), x.col(3) = Vec3(0.002, -0.003 * std::cos(angle), -0.003 * std::sin(angle));
  ShakenSystem scenario;
  scenario.system.rest = make_particles(x, Eigen::VectorXd::Constant(4, 1e4));
  scenario.system.dihedrals = build_dihedral_set({{{0, 1, 2, 3}, 0, compliance, 0.004}}, 4);
  scenario.state = make_state(scenario.system);
  return scenario;
}

ProjectionCounts project_all(ShakenSystem& scenario, const ProjectionParameters& parameters) {
  return project_dihedrals(scenario.system.dihedrals, scenario.system.dihedrals.order.colors.at(0),
                           scenario.state.dihedral_lambda.data(), scenario.state.start, scenario.state.particles,
                           parameters);
}

}  // namespace

TEST(DihedralProjection, moves_no_vertex_farther_than_the_limit_and_counts_it) {
  ProjectionParameters parameters;
  parameters.dihedral_limit = 0.05f;
  ShakenSystem scenario = one_dihedral(2.5, 0);
  const Points before = real_positions_of(scenario.state.particles);
  EXPECT_EQ(project_all(scenario, parameters).limited, 1);
  EXPECT_NEAR(farthest(before, real_positions_of(scenario.state.particles)), 0.05 * 0.004, 1e-8);

  ShakenSystem free = one_dihedral(2.5, 0);
  parameters.dihedral_limit = 0;
  EXPECT_EQ(project_all(free, parameters).limited, 0);
  EXPECT_GT(farthest(before, real_positions_of(free.state.particles)), 0.001);
}

TEST(DihedralProjection, gives_back_the_multiplier_of_a_motion_held_back) {
  ProjectionParameters parameters;
  ShakenSystem free = one_dihedral(2.5, 0), held = one_dihedral(2.5, 0);
  const Points before = real_positions_of(free.state.particles);
  project_all(free, parameters);
  parameters.dihedral_limit = 0.05f;
  project_all(held, parameters);
  const auto slot = static_cast<std::size_t>(slots_of(free.system.dihedrals)[0]);
  const Real motion_share = farthest(before, real_positions_of(held.state.particles)) /
                            farthest(before, real_positions_of(free.state.particles));
  EXPECT_NEAR(held.state.dihedral_lambda[slot] / free.state.dihedral_lambda[slot], motion_share, 1e-5);
}

TEST(DihedralProjection, near_half_a_turn_takes_the_short_way_back) {
  ShakenSystem scenario = one_dihedral(-pi + 0.01, 0);
  scenario.system.dihedrals.rest_angle[static_cast<std::size_t>(slots_of(scenario.system.dihedrals)[0])] =
      static_cast<float>(pi - 0.01);
  const Points before = real_positions_of(scenario.state.particles);
  project_all(scenario, {});
  const Points after = real_positions_of(scenario.state.particles);
  EXPECT_LT(farthest(before, after), 0.003 * 0.03);
  EXPECT_GT(farthest(before, after), 0.003 * 0.002);
}

TEST(DihedralProjection, a_flat_triangle_is_skipped_and_counted_and_moves_nothing) {
  ShakenSystem scenario = one_dihedral(1, 0);
  scenario.state.particles.position(2) = Eigen::Vector3f(0.002f, 0, 0);
  const AlignedVector<float> before = scenario.state.particles.xyzw;
  EXPECT_EQ(project_all(scenario, {}).skipped, 1);
  EXPECT_EQ(scenario.state.particles.xyzw, before);
}

TEST(DistanceProjection, an_edge_without_length_is_skipped_and_counted_and_moves_nothing) {
  for (float beta : {0.0f, 0.5f}) {
    ProjectionParameters parameters;
    parameters.rayleigh_beta = beta;
    Particles particles = make_particles(Points::Constant(3, 2, 0.01), Eigen::Vector2d(1, 2));
    const DistanceSet set = build_distance_set({{0, 1, 0.005, 0.01}}, 2);
    AlignedVector<float> lambda(set.a.size(), 0);
    const AlignedVector<float> before = particles.xyzw;
    const ProjectionCounts counts = project_distances(set, set.order.colors.at(0), set.rest_length.data(),
                                                      lambda.data(), particles, particles, parameters);
    EXPECT_EQ(counts.skipped, 1);
    EXPECT_EQ(particles.xyzw, before);
    for (float value : lambda) EXPECT_TRUE(std::isfinite(value));
  }
}

TEST(Projection, padding_and_fixed_particles_stay_where_they_are_and_never_turn_nan) {
  for (ProjectionParameters parameters : parameter_sets())
    for (bool arccos : {false, true}) {
      parameters.arccos_dihedrals = arccos;
      ShakenSystem scenario = shaken(13);
      SurfaceState& state = scenario.state;
      const Particles before = state.particles;
      for (int repeat = 0; repeat < 5; ++repeat) {
        for (const ColorRange& color : scenario.system.distances.order.colors) {
          project_distances(scenario.system.distances, color, state.target_length.data(), state.distance_lambda.data(),
                            state.start, state.particles, parameters);
          project_strain_limit(scenario.system.distances, color, 1.01f, state.particles);
        }
        for (const ColorRange& color : scenario.system.dihedrals.order.colors)
          project_dihedrals(scenario.system.dihedrals, color, state.dihedral_lambda.data(), state.start,
                            state.particles, parameters);
      }
      EXPECT_TRUE(is_finite(state.particles));
      for (int k = 0; k < 4; ++k) EXPECT_EQ(state.particles.at(state.particles.count())[k], 0);
      for (const AlignedVector<float>* lambdas : {&state.distance_lambda, &state.dihedral_lambda})
        for (float lambda : *lambdas) EXPECT_TRUE(std::isfinite(lambda));
      Index fixed = 0;
      for (Index i = 0; i < before.count(); ++i) {
        EXPECT_EQ(state.particles.inverse_mass(i), before.inverse_mass(i));
        if (before.inverse_mass(i) > 0) continue;
        ++fixed;
        EXPECT_EQ(state.particles.position(i), before.position(i));
      }
      EXPECT_GT(fixed, 10);
    }
}

TEST(StrainLimit, shortens_what_is_too_long_to_the_limit_and_leaves_the_rest) {
  Points x(3, 6);
  for (Index i = 0; i < 6; ++i) x.col(i) = Vec3(0, 0.01 * i, 0);
  x.col(1).x() = 0.03, x.col(3).x() = 0.019, x.col(5).x() = 0.05;
  x.col(1).y() = x.col(0).y(), x.col(3).y() = x.col(2).y(), x.col(5).y() = x.col(4).y();
  Eigen::VectorXd inverse_masses(6);
  inverse_masses << 1, 3, 1, 1, 0, 2;
  Particles particles = make_particles(x, inverse_masses);
  const DistanceSet set = build_distance_set({{0, 1, 0.01, 0}, {2, 3, 0.01, 0}, {4, 5, 0.01, 0}}, 6);
  ASSERT_EQ(set.order.colors.size(), 1u);
  EXPECT_EQ(project_strain_limit(set, set.order.colors[0], 2, particles), 2);
  EXPECT_NEAR((particles.position(1) - particles.position(0)).norm(), 0.02, 1e-8);
  EXPECT_NEAR(particles.position(0).x(), 0.01 / 4, 1e-8);  // the lighter end gives three times as much
  EXPECT_NEAR((particles.position(5) - particles.position(4)).norm(), 0.02, 1e-8);
  EXPECT_EQ(particles.position(4).x(), 0);
  EXPECT_EQ(particles.position(3).x(), 0.019f);
  EXPECT_EQ(project_strain_limit(set, set.order.colors[0], 2.001f, particles), 0);
}

/// Whether the first edge of a set is shortened that had the first length when distances were projected and has the
/// second after.
bool is_limited(const DistanceSet& set, double when_projected, float after) {
  Points x = Points::Zero(3, 3);
  x(0, 1) = when_projected;
  Particles particles = make_particles(x, Eigen::Vector3d(1, 1, 0));
  AlignedVector<float> lambda(set.a.size(), 0);
  StrainLimitActiveSet active;
  build_active_set(set, 2, active);
  deactivate_all(active);
  const Index group = set.slot[0] / group_width * group_width;
  const ColorRange range{group, group + group_width};
  project_distances(set, range, set.rest_length.data(), lambda.data(), particles, particles, {}, &active);
  particles.at(1)[0] = after;
  return project_strain_limit(set, range, 2, particles, &active) > 0;
}

constexpr double soft = 1e9;  // so that projecting a distance moves nothing

TEST(StrainLimit, looks_only_where_an_edge_came_near_it_when_distances_were_projected) {
  const DistanceSet set = build_distance_set({{0, 1, 0.01, soft}}, 3);
  EXPECT_FALSE(is_limited(set, 0.0179, 0.03f));
  EXPECT_TRUE(is_limited(set, 0.0181, 0.03f));
}

TEST(StrainLimit, comes_near_within_half_of_the_edge_or_of_a_longer_one_beside_it) {
  const DistanceSet alone = build_distance_set({{0, 1, 0.001, soft}}, 3);
  EXPECT_FALSE(is_limited(alone, 0.00149, 0.003f));
  EXPECT_TRUE(is_limited(alone, 0.00151, 0.003f));
  const DistanceSet beside = build_distance_set({{0, 1, 0.001, soft}, {1, 2, 0.003, soft}}, 3);
  EXPECT_TRUE(is_limited(beside, 0.0006, 0.003f));
  EXPECT_FALSE(is_limited(beside, 0.0004, 0.003f));
}

TEST(StrainLimitActiveSet, begins_anew_only_for_another_limit) {
  const DistanceSet set = build_distance_set({{0, 1, 0.001, soft}}, 2);
  StrainLimitActiveSet active;
  build_active_set(set, 2, active);
  EXPECT_EQ(active.groups, std::vector<char>{1});
  EXPECT_FLOAT_EQ(active.from[static_cast<std::size_t>(set.slot[0])], 0.0015f);
  active.groups = {0};
  build_active_set(set, 2, active);
  EXPECT_EQ(active.groups, std::vector<char>{0});
  build_active_set(set, 3, active);
  EXPECT_EQ(active.groups, std::vector<char>{1});
  EXPECT_FLOAT_EQ(active.from[static_cast<std::size_t>(set.slot[0])], 0.0025f);
}

}  // namespace gracilis
