#include <gracilis/anatomy/sections/spindle.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/opensim/import/belly_length.hpp>
#include <gracilis/opensim/import/muscle_names.hpp>
#include <gracilis/opensim/import/muscle_volume.hpp>
#include <gracilis/opensim/kinematics/skeleton.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>

#include <build_paths.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

static constexpr Real tension = 6.1e5;

static Muscle muscle_of(const std::string& name, Real fiber, Real slack, Real pennation_deg, Real force = 1000) {
  Muscle muscle;
  muscle.name = name;
  muscle.optimal_fiber_length = fiber;
  muscle.tendon_slack_length = slack;
  muscle.pennation_angle_at_optimal = radians(pennation_deg);
  muscle.max_isometric_force = force;
  return muscle;
}

TEST(BellyLength, names_of_sides_and_heads_are_one) {
  for (const char* name : {"glut_max1_r", "glut_max_3_l", "GlutMax2_right", "r_glut_max"})
    EXPECT_EQ(plain_muscle_name(name), "glutmax");
  EXPECT_EQ(plain_muscle_name("soleus"), "soleus");
  EXPECT_EQ(plain_muscle_name("addmagProx_l"), "addmagprox");
}

TEST(BellyLength, a_known_muscle_has_the_published_one_and_grows_with_the_model) {
  // gait2392's own lengths; Ward et al. 2009.
  const Muscle semimembranosus = muscle_of("semimem_r", 0.08, 0.359, 15);
  EXPECT_NEAR(belly_length(semimembranosus, tension), 0.2934, 3e-4);
  EXPECT_NEAR(belly_length(muscle_of("grac_l", 0.352, 0.126, 3), tension), 0.2869, 3e-4);
  EXPECT_NEAR(belly_length(muscle_of("SemiMembranosus", 0.16, 0.718, 15), tension),
              2 * belly_length(semimembranosus, tension), 1e-12);
}

TEST(BellyLength, half_of_an_aponeurosis_lies_before_lines_that_begin_amid_a_long_origin) {
  const Muscle soleus = muscle_of("soleus_l", 0.05, 0.25, 25);
  EXPECT_NEAR(belly_length(soleus, tension), (0.4054 + 0.044) / 2, 5e-4);
}

TEST(BellyLength, another_muscles_follows_from_fibers_pennation_and_cross_section) {
  const Real width = std::sqrt(500 / tension);
  EXPECT_NEAR(belly_length(muscle_of("nobody", 0.1, 0.2, 20, 500), tension),
              0.1 * std::cos(radians(20)) + width / std::sin(radians(20)), 1e-12);
  // What is hardly pennate is taken for 10 degrees.
  EXPECT_NEAR(belly_length(muscle_of("nobody", 0.1, 0.2, 0, 500), tension), 0.1 + width / std::sin(radians(10)), 1e-12);
}

TEST(BellyLength, a_line_keeps_a_tenth_for_the_tendon_and_a_fifth_for_the_belly) {
  EXPECT_NEAR(belly_on_line(muscle_of("vas_int_r", 0.087, 0.136, 3), tension, 0.25), 0.225, 1e-12);
  EXPECT_NEAR(belly_on_line(muscle_of("nobody", 0.01, 1, 20, 1), tension, 1), 0.2, 1e-12);
}

/// A model's muscle about its line, its tendon placed so.
static MuscleVolume placed(const Model& model, const Muscle& muscle, TendonPlace tendon) {
  Skeleton skeleton(model);
  const Eigen::VectorXd coordinates = default_coordinates(model);
  skeleton.place(coordinates);
  VolumeSettings settings;
  settings.tendon = tendon;
  settings.tendon_sections = true;
  settings.section_distance = 0.004;
  return muscle_volume(model, muscle, skeleton.poses(), coordinates, settings);
}

TEST(BellyLength, a_longer_belly_is_thinner_and_has_the_same_volume) {
  const Model model =
      read_model(std::filesystem::path(build_paths::source_folder) / "tests/opensim/reference/rajagopal18_right.osim");
  int compared = 0;
  for (const Muscle& muscle : model.muscles) {
    if (!muscle.path.function_coordinates.empty()) continue;
    const MuscleVolume belly = placed(model, muscle, TendonPlace::beyond_belly);
    const Real length = polyline_length(belly.line.points);
    EXPECT_GE(belly.line.tendon, 0.1 * length - 1e-9) << muscle.name;
    EXPECT_NEAR(length - belly.line.tendon, belly_on_line(muscle, tension, length), 1e-9) << muscle.name;
    EXPECT_EQ(belly.tendon_share, 1) << muscle.name;
    const MuscleSize size{muscle.max_isometric_force, muscle.optimal_fiber_length, muscle.pennation_angle_at_optimal};
    // Twelve corners instead of a circle take 4.5 % away; round muscles overlap themselves where lines turn.
    const Real tendon = pi * std::pow(tendon_radius(size), 2) * belly.line.tendon;
    const Real volume = enclosed_volume(belly.surface.vertices, belly.surface.faces);
    EXPECT_NEAR(volume / (0.955 * (gracilis::muscle_volume(size) + tendon)), 1, 0.05) << muscle.name;
    ++compared;
  }
  EXPECT_EQ(compared, 9);
}

}  // namespace gracilis::opensim
