#include <gracilis/methods/xpbd/level.hpp>
#include <gracilis/strings/bone_distances.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {
namespace {

/// The tube, whole and as a coarser copy that is simulated in its place.
struct TwoLevels {
  TwoLevels()
      : full(xpbd::make_level(scene, tube_fields(), carried())),
        coarse(xpbd::make_coarser_level(scene, full, tube_fields())) {}

  std::vector<xpbd::CarryingStrings> carried() const {
    return xpbd::carrying_strings(scene, strings::bone_distances(scene, {}));
  }
  const xpbd::PreparedMuscle& whole() const { return full.muscles[0]; }
  const xpbd::PreparedMuscle& copy() const { return coarse.level.muscles[0]; }
  const xpbd::Prolongation& prolongation() const { return coarse.prolongations[0]; }

  /// Particles of the whole surface where the copy in this state takes them, about its origin, m.
  Points prolonged(const xpbd::MuscleState& of_copy, const Pose& pose) const {
    Particles particles = full.states[0].particles;
    prolong(prolongation(), copy(), of_copy, whole(), full.states[0], pose, particles);
    return places(particles);
  }
  static Points places(const Particles& particles) {
    Points points(3, particles.count());
    for (Index p = 0; p < particles.count(); ++p) points.col(p) = particles.position(p).cast<Real>();
    return points;
  }

  Scene scene = [] {
    XpbdSettings settings;
    settings.simulated_edge = 0.008;
    settings.skinning = Skinning::bodies;
    return tube_scene(settings);
  }();
  xpbd::Level full;
  xpbd::CoarserLevel coarse;
};

Pose at_rest(const Scene& scene) { return capture_pose(scene.bodies.size()); }

}  // namespace

TEST(Levels, a_copy_is_coarser_and_made_of_vertices_of_the_surface) {
  const TwoLevels levels;
  EXPECT_LT(2 * triangle_count(levels.coarse.level), triangle_count(levels.full));
  for (std::size_t i = 0; i < levels.prolongation().picked.size(); ++i) {
    const auto p = static_cast<Index>(levels.prolongation().picked[i]);
    EXPECT_LT((levels.copy().rest.col(static_cast<Index>(i)) - levels.whole().rest.col(p)).norm(), 1e-9);
  }
}

TEST(Levels, what_a_vertex_takes_from_the_copy_sums_to_one) {
  const TwoLevels levels;
  for (const Eigen::Vector3f& weights : levels.prolongation().weights) EXPECT_NEAR(weights.sum(), 1, 1e-5f);
}

TEST(Levels, a_copy_that_is_not_displaced_leaves_the_surface_where_the_bodies_carry_it) {
  const TwoLevels levels;
  const Points rest = TwoLevels::places(levels.full.states[0].particles);
  const Points there = levels.prolonged(levels.coarse.level.states[0], at_rest(levels.scene));
  EXPECT_LT((there - rest).colwise().norm().maxCoeff(), 1e-6);
}

TEST(Levels, the_surface_goes_where_its_copy_goes_and_the_copy_back_to_where_it_was) {
  const TwoLevels levels;
  xpbd::MuscleState moved = levels.coarse.level.states[0];
  for (Index p = 0; p < moved.particles.count(); ++p)
    if (moved.particles.inverse_mass(p) > 0) moved.particles.position(p) += Eigen::Vector3f(0.002f, 0, 0.001f);
  Particles surface = levels.full.states[0].particles;
  prolong(levels.prolongation(), levels.copy(), moved, levels.whole(), levels.full.states[0], at_rest(levels.scene),
          surface);
  Particles back = moved.particles;
  restrict_to_copy(levels.prolongation(), levels.whole(), surface, levels.copy(), back);
  EXPECT_LT((TwoLevels::places(back) - TwoLevels::places(moved.particles)).colwise().norm().maxCoeff(), 1e-6);
  const Points rest = TwoLevels::places(levels.full.states[0].particles);
  EXPECT_NEAR((TwoLevels::places(surface) - rest).colwise().norm().maxCoeff(), std::hypot(0.002, 0.001), 1e-4);
}

TEST(Levels, a_step_that_fails_leaves_the_level_as_it_was) {
  TwoLevels levels;
  Pose nowhere = flexed(levels.scene, radians(10));
  nowhere.bodies[1].translation().x() = std::nan("");
  std::vector<xpbd::MuscleState> next = levels.full.states;
  std::vector<xpbd::StepCounts> counts(1);
  const Points before = TwoLevels::places(levels.full.states[0].particles);
  EXPECT_THROW(advance(levels.full, at_rest(levels.scene), nowhere, {0}, next, counts), QualityError);
  EXPECT_EQ(TwoLevels::places(levels.full.states[0].particles), before);
}

TEST(Levels, a_reset_brings_all_back_to_rest) {
  TwoLevels levels;
  std::vector<xpbd::MuscleState> next = levels.full.states;
  std::vector<xpbd::StepCounts> counts(1);
  const Points before = TwoLevels::places(levels.full.states[0].particles);
  advance(levels.full, at_rest(levels.scene), flexed(levels.scene, radians(10)), {0}, next, counts);
  levels.full.states = next;
  EXPECT_GT((TwoLevels::places(next[0].particles) - before).norm(), 1e-3);
  reset(levels.full);
  EXPECT_EQ(TwoLevels::places(levels.full.states[0].particles), before);
}

}  // namespace gracilis
