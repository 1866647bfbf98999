#include <gracilis/view/pictures/color_scale.hpp>
#include <gracilis/view/pictures/muscle_colors.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gracilis {

/// How people see linear red, green and blue: as most do; without the cones for long, middle and short waves (Machado,
/// Oliveira and Fernandes 2009, severity 1); in gray print.
static std::vector<std::pair<const char*, Eigen::Matrix3d>> visions() {
  Eigen::Matrix3d protan, deutan, tritan, gray;
  protan << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998;
  deutan << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881;
  tritan << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900;
  gray.rowwise() = Eigen::RowVector3d(0.2126, 0.7152, 0.0722);
  return {{"most people", Eigen::Matrix3d::Identity()},
          {"protanopia", protan},
          {"deuteranopia", deutan},
          {"tritanopia", tritan},
          {"gray print", gray}};
}

/// In the CIE's L*a*b* of 1976 under D65; 2.3 are just noticeable.
static Vec3 perceived(const Color& color, const Eigen::Matrix3d& vision = Eigen::Matrix3d::Identity()) {
  const auto linear = [](Real c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  const Vec3 rgb = (vision * color.unaryExpr(linear)).cwiseMax(0).cwiseMin(1);
  const Vec3 xyz(Vec3(0.4124, 0.3576, 0.1805).dot(rgb) / 0.9505, Vec3(0.2126, 0.7152, 0.0722).dot(rgb),
                 Vec3(0.0193, 0.1192, 0.9505).dot(rgb) / 1.089);
  const auto root = [](Real t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  return {116 * root(xyz.y()) - 16, 500 * (root(xyz.x()) - root(xyz.y())), 200 * (root(xyz.y()) - root(xyz.z()))};
}

static Real difference(const Color& a, const Color& b, const Eigen::Matrix3d& vision) {
  return (perceived(a, vision) - perceived(b, vision)).norm();
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

TEST(MuscleColors, are_those_of_a_muscle_by_each_of_its_names) {
  EXPECT_EQ(muscle_color("vas_lat_r"), muscle_color("vastus_lateralis_l"));
  EXPECT_EQ(muscle_color("perlong_r"), muscle_color("fibularis_longus_r"));
  EXPECT_EQ(muscle_color("Biceps femoris long"), muscle_color("bifemlh_r"));
}

/// Muscles, each with some that touch it.
static const std::vector<std::pair<const char*, std::vector<const char*>>> neighbors = {
    {"gluteus_maximus",
     {"gluteus_medius", "gluteus_minimus", "biceps_femoris_long", "semitendinosus", "piriformis", "quadratus_femoris",
      "inferior_gemellus", "superior_gemellus", "obturator_internus", "vastus_lateralis", "adductor_magnus"}},
    {"gluteus_medius", {"gluteus_minimus", "piriformis", "rectus_femoris", "vastus_lateralis"}},
    {"iliacus", {"psoas_major", "rectus_femoris", "vastus_intermedius", "psoas_minor"}},
    {"adductor_brevis", {"adductor_longus", "adductor_magnus"}},
    {"adductor_longus", {"adductor_magnus"}},
    {"pectineus", {"adductor_longus", "adductor_brevis", "psoas_major", "iliacus"}},
    {"gracilis",
     {"adductor_magnus", "adductor_longus", "adductor_brevis", "sartorius", "semimembranosus", "semitendinosus"}},
    {"rectus_femoris", {"vastus_lateralis", "vastus_intermedius", "vastus_medialis"}},
    {"vastus_lateralis", {"vastus_intermedius", "biceps_femoris_short", "biceps_femoris_long"}},
    {"vastus_intermedius", {"vastus_medialis"}},
    {"sartorius",
     {"rectus_femoris", "vastus_medialis", "adductor_longus", "adductor_magnus", "semimembranosus", "iliacus"}},
    {"semimembranosus", {"semitendinosus", "biceps_femoris_long", "adductor_magnus"}},
    {"semitendinosus", {"biceps_femoris_long", "adductor_magnus"}},
    {"biceps_femoris_long", {"biceps_femoris_short", "adductor_magnus"}},
    {"biceps_femoris_short", {"adductor_magnus"}},
    {"vastus_medialis", {"adductor_magnus", "adductor_longus", "adductor_brevis", "pectineus", "iliacus"}},
    {"gluteus_minimus", {"piriformis", "rectus_femoris", "vastus_lateralis"}},
    {"piriformis", {"superior_gemellus"}},
    {"superior_gemellus", {"obturator_internus"}},
    {"obturator_internus", {"inferior_gemellus"}},
    {"inferior_gemellus", {"quadratus_femoris", "obturator_externus"}},
    {"quadratus_femoris", {"adductor_magnus", "adductor_minimus"}},
    {"obturator_externus",
     {"quadratus_femoris", "adductor_brevis", "adductor_magnus", "adductor_minimus", "pectineus", "iliacus",
      "psoas_major"}},
    {"tensor_fasciae_latae",
     {"rectus_femoris", "vastus_lateralis", "sartorius", "gluteus_medius", "gluteus_minimus", "gluteus_maximus"}},
    {"adductor_minimus", {"adductor_magnus", "adductor_brevis"}},
    {"gastrocnemius_medial", {"gastrocnemius_lateral", "soleus", "semimembranosus", "semitendinosus"}},
    {"gastrocnemius_lateral", {"soleus", "biceps_femoris_long", "biceps_femoris_short", "plantaris"}},
    {"soleus",
     {"plantaris", "flexor_hallucis_longus", "flexor_digitorum_longus", "tibialis_posterior", "fibularis_longus",
      "fibularis_brevis"}},
    {"popliteus",
     {"plantaris", "gastrocnemius_medial", "gastrocnemius_lateral", "soleus", "tibialis_posterior",
      "flexor_digitorum_longus"}},
    {"fibularis_longus", {"fibularis_brevis", "flexor_hallucis_longus"}},
    {"fibularis_brevis", {"fibularis_tertius", "flexor_hallucis_longus"}},
    {"tibialis_anterior", {"extensor_digitorum_longus", "extensor_hallucis_longus"}},
    {"extensor_digitorum_longus",
     {"extensor_hallucis_longus", "fibularis_tertius", "fibularis_longus", "fibularis_brevis"}},
    {"tibialis_posterior", {"flexor_digitorum_longus", "flexor_hallucis_longus"}},
    {"flexor_digitorum_longus", {"flexor_hallucis_longus"}},
    {"biceps_long", {"biceps_short", "brachialis", "brachioradialis"}},
    {"biceps_short", {"brachialis"}},
    {"brachialis", {"brachioradialis", "triceps_lateral", "triceps_medial"}},
    {"triceps_long", {"triceps_lateral", "triceps_medial"}},
    {"triceps_lateral", {"triceps_medial", "anconeus"}},
    {"brachioradialis", {"triceps_lateral"}},
    {"triceps_medial", {"anconeus"}},
    {"erector_spinae", {"quadratus_lumborum", "latissimus_dorsi"}},
    {"external_oblique", {"internal_oblique", "latissimus_dorsi"}},
    {"rectus_abdominis", {"external_oblique", "internal_oblique"}},
    {"internal_oblique", {"quadratus_lumborum"}},
    {"psoas_major", {"quadratus_lumborum", "psoas_minor"}},
    {"deltoid",
     {"supraspinatus", "infraspinatus", "subscapularis", "teres_minor", "pectoralis_major", "biceps_long",
      "biceps_short", "triceps_lateral", "triceps_long", "coracobrachialis"}},
    {"supraspinatus", {"infraspinatus", "subscapularis"}},
    {"infraspinatus", {"teres_minor", "teres_major"}},
    {"teres_minor", {"teres_major", "triceps_long"}},
    {"teres_major", {"latissimus_dorsi", "triceps_long"}},
    {"subscapularis", {"teres_major", "latissimus_dorsi"}},
    {"coracobrachialis", {"biceps_short", "subscapularis", "brachialis"}},
    {"pectoralis_major", {"biceps_long", "biceps_short", "coracobrachialis"}}};

TEST(MuscleColors, of_neighbors_differ_for_every_kind_of_color_vision_and_in_gray_print) {
  for (const auto& [vision, matrix] : visions())
    for (const auto& [muscle, others] : neighbors)
      for (const char* other : others)
        EXPECT_GT(difference(muscle_color(muscle), muscle_color(other), matrix), 7)
            << vision << ": " << muscle << " and " << other;
}

TEST(MuscleColors, of_parts_that_lie_side_by_side_differ_for_every_kind_of_color_vision) {
  for (const auto& [vision, matrix] : visions())
    for (const std::string muscle : {"glut_max", "glut_med", "glut_min", "add_mag"})
      for (int part = 1; part < 3; ++part)
        EXPECT_GT(difference(muscle_color(muscle + std::to_string(part)),
                             muscle_color(muscle + std::to_string(part + 1)), matrix),
                  4)
            << vision << ": " << muscle << part;
}

TEST(MuscleColors, are_neither_paper_nor_bone) {
  for (const auto& [vision, matrix] : visions())
    for (const auto& [muscle, others] : neighbors)
      for (const Color& color : {Color(Color::Ones()), bone_color()})
        EXPECT_GT(difference(muscle_color(muscle), color, matrix), 15) << vision << ": " << muscle;
}

TEST(ColorScales, can_be_read_with_every_kind_of_color_vision) {
  for (const auto& [vision, matrix] : visions()) {
    if (std::string(vision) == "gray print") continue;
    for (const ColorScale& scale : color_scales())
      for (std::size_t i = 0; i < scale.colors.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_GT(difference(scale.colors[i], scale.colors[j], matrix), 10) << vision << ": " << scale.name << i << j;
  }
}

TEST(ColorScales, are_ordered_by_lightness_from_their_light_end_or_their_middle) {
  for (const ColorScale& scale : color_scales()) {
    std::vector<Real> lightness;
    for (const Color& color : scale.colors) lightness.push_back(perceived(color).x());
    const bool has_middle = scale.colors.size() == 5, falls = !has_middle && scale.name == "bone-gap";
    for (std::size_t i = 0; i + 1 < lightness.size(); ++i) {
      const bool rises = has_middle ? i < 2 : falls;
      EXPECT_GT(rises ? lightness[i + 1] - lightness[i] : lightness[i] - lightness[i + 1], 7) << scale.name << i;
    }
  }
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
