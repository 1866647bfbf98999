#include <gracilis/dynamics/constraints/compliance.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/registry.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <limits>

/// What the ranges of the stiffnesses allow must run.
namespace gracilis {
namespace {

Points bent(const SettingValues& settings) {
  Scene scene = tube_scene();
  for (const auto& [key, value] : settings) scene.method.settings[key] = value;
  const auto method = make_method(scene, [](const DistanceFieldSettings&) { return tube_fields(); });
  for (const Real angle : {15, 30, 45}) method->advance(flexed(scene, radians(angle)), usual_time_step);
  return frame_of(*method, flexed(scene, radians(45)), 3).muscles[0].points;
}

TEST(StiffnessLimits, no_stiffness_at_all_gives_finite_shapes_with_their_volume) {
  const Scene scene = tube_scene();
  const TriangleMesh& rest = scene.muscles[0].surface;
  for (const Real rayleigh_beta : {0.0, 1e6})
    for (const SettingValues& settings :
         {SettingValues{{"distance_stiffness", 0.0}}, SettingValues{{"dihedral_stiffness", 0.0}},
          SettingValues{{"distance_stiffness", 0.0}, {"dihedral_stiffness", 0.0}}}) {
      SettingValues all = settings;
      all["rayleigh_beta"] = rayleigh_beta;
      const Points points = bent(all);
      ASSERT_TRUE(points.allFinite()) << settings.begin()->first;
      EXPECT_NEAR(enclosed_volume(points, rest.faces) / enclosed_volume(rest.vertices, rest.faces), 1, 0.01);
    }
}

TEST(StiffnessLimits, the_largest_stiffness_gives_finite_shapes) {
  EXPECT_TRUE(bent({{"distance_stiffness", 1e18}, {"dihedral_stiffness", 1e18}}).allFinite());
}

TEST(StiffnessLimits, compliance_of_nothing_is_finite_in_single_precision_over_the_shortest_steps) {
  constexpr Real shortest_step = 1e-6;
  const Real softest = compliance_of(0) / (shortest_step * shortest_step);
  EXPECT_LT(softest, static_cast<Real>(std::numeric_limits<float>::max()));
  EXPECT_EQ(compliance_of(4), 0.25);
}

}  // namespace
}  // namespace gracilis
