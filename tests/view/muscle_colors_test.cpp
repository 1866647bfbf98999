#include <gracilis/view/pictures/muscle_colors.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace gracilis {

/// In the CIE's L*a*b* of 1976 under D65; 2.3 are just noticeable.
static Vec3 perceived(const Color& color) {
  const auto linear = [](Real c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  const Vec3 rgb(linear(color.x()), linear(color.y()), linear(color.z()));
  const Vec3 xyz(Vec3(0.4124, 0.3576, 0.1805).dot(rgb) / 0.9505, Vec3(0.2126, 0.7152, 0.0722).dot(rgb),
                 Vec3(0.0193, 0.1192, 0.9505).dot(rgb) / 1.089);
  const auto root = [](Real t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  return {116 * root(xyz.y()) - 16, 500 * (root(xyz.x()) - root(xyz.y())), 200 * (root(xyz.y()) - root(xyz.z()))};
}

static void expect_all_differ(const std::vector<const char*>& names) {
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT((perceived(muscle_color(names[i])) - perceived(muscle_color(names[j]))).norm(), 7)
          << names[i] << " and " << names[j];
}

TEST(MuscleColors, are_of_names_and_the_same_on_both_sides) {
  EXPECT_EQ(muscle_color("gluteus_maximus_r"), muscle_color("gluteus_maximus_l"));
  EXPECT_EQ(muscle_color("Gluteus maximus"), muscle_color("gluteus_maximus_r"));
  EXPECT_EQ(muscle_color("nobody_knows_r"), muscle_color("nobody_knows_r"));
  EXPECT_NE(muscle_color("nobody_knows_1"), muscle_color("nobody_knows_2"));
  EXPECT_NE(muscle_color("biceps_femoris_long_r"), muscle_color("biceps_brachii_long_r"));
}

TEST(MuscleColors, of_neighbors_differ_in_lightness) {
  const auto lightness = [](const char* name) { return Vec3(0.2126, 0.7152, 0.0722).dot(muscle_color(name)); };
  const std::pair<const char*, const char*> neighbors[] = {{"gluteus_maximus_r", "gluteus_medius_r"},
                                                           {"iliacus_r", "psoas_major_r"},
                                                           {"adductor_brevis_r", "adductor_longus_r"},
                                                           {"glut_max1_r", "glut_max2_r"},
                                                           {"vas_lat_r", "vas_int_r"},
                                                           {"biceps_long", "biceps_short"},
                                                           {"triceps_long", "triceps_lateral"},
                                                           {"triceps_lateral", "triceps_medial"},
                                                           {"triceps_long", "triceps_medial"}};
  for (const auto& [one, other] : neighbors) EXPECT_GT(std::abs(lightness(one) - lightness(other)), 0.05) << one;
}

TEST(MuscleColors, of_all_muscles_of_gait2392_and_of_their_parts_differ) {
  expect_all_differ({"glut_med1_r", "glut_med2_r", "glut_med3_r", "glut_min1_r", "glut_min2_r", "glut_min3_r",
                     "semimem_r",   "semiten_r",   "bifemlh_r",   "bifemsh_r",   "sar_r",       "add_long_r",
                     "add_brev_r",  "add_mag1_r",  "add_mag2_r",  "add_mag3_r",  "tfl_r",       "pect_r",
                     "grac_r",      "glut_max1_r", "glut_max2_r", "glut_max3_r", "iliacus_r",   "psoas_r",
                     "quad_fem_r",  "gem_r",       "peri_r",      "rect_fem_r",  "vas_med_r",   "vas_int_r",
                     "vas_lat_r",   "med_gas_r",   "lat_gas_r",   "soleus_r",    "tib_post_r",  "flex_dig_r",
                     "flex_hal_r",  "tib_ant_r",   "per_brev_r",  "per_long_r",  "per_tert_r",  "ext_dig_r",
                     "ext_hal_r",   "ercspn_r",    "intobl_r",    "extobl_r"});
}

TEST(MuscleColors, of_all_muscles_of_a_scanned_leg_differ) {
  expect_all_differ({"adductor_brevis_r",
                     "adductor_longus_r",
                     "adductor_magnus_r",
                     "adductor_minimus_r",
                     "biceps_femoris_long_r",
                     "biceps_femoris_short_r",
                     "gluteus_maximus_r",
                     "gluteus_medius_r",
                     "gluteus_minimus_r",
                     "gracilis_r",
                     "iliacus_r",
                     "inferior_gemellus_r",
                     "obturator_externus_r",
                     "obturator_internus_r",
                     "pectineus_r",
                     "piriformis_r",
                     "psoas_major_r",
                     "quadratus_femoris_r",
                     "rectus_femoris_r",
                     "sartorius_r",
                     "semimembranosus_r",
                     "semitendinosus_r",
                     "superior_gemellus_r",
                     "vastus_intermedius_r",
                     "vastus_lateralis_r",
                     "vastus_medialis_r"});
}

TEST(MuscleColors, of_nine_parts_of_a_muscle_differ_and_are_no_other_muscles) {
  std::set<std::vector<Real>> colors;
  const auto add = [&](const std::string& name) {
    const Color color = muscle_color(name);
    colors.insert({color.x(), color.y(), color.z()});
  };
  for (const char* muscle : {"glut_max", "glut_med", "glut_min"})
    for (int part = 1; part <= 9; ++part) add(muscle + std::to_string(part));
  EXPECT_EQ(colors.size(), 27u);
}

}  // namespace gracilis
