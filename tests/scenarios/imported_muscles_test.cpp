#include <io/test_files.hpp>
#include <opensim/model_texts.hpp>
#include "scenario_runs.hpp"

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/sections/line_sections.hpp>
#include <gracilis/opensim/import/scene_folder.hpp>
#include <gracilis/opensim/kinematics/coordinate_motion.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>

#include <gmock/gmock.h>

#include <algorithm>

namespace gracilis {

using opensim::coordinate_motion;
using opensim::CoordinateMotion;
using opensim::GeometryPlaces;
using opensim::Model;
using opensim::NamedMotion;
using opensim::read_model;
using opensim::SceneFolderSettings;

/// The scene that import makes of a model and a motion, for XPBD, read with these options.
static Scene imported(const Model& model, const GeometryPlaces& places, const NamedMotion& motion,
                      const SceneFolderSettings& settings = {}, const SceneOptions& options = {}) {
  const TestFolder folder;
  const std::vector<std::string> left_out =
      write_scene_folder(model, places, {motion}, settings, folder.path()).left_out;
  // What there is no room for between others, and for tendons on a line: some models' slack lengths stand for none.
  const auto between_others = testing::HasSubstr("between the others there is room for");
  EXPECT_THAT(left_out, testing::Each(testing::AnyOf(between_others, testing::HasSubstr("% of the tendon"))));
  EXPECT_TRUE(settings.apart || std::none_of(left_out.begin(), left_out.end(), [](const std::string& each) {
                return each.find("between the others") != std::string::npos;
              }));
  return read_scene(folder.path() / (motion.name + ".toml"), options).scene;
}

class ImportedHip : public testing::TestWithParam<const char*> {};

/// The hip model in one of its motions.
static Scene imported_hip(const std::string& motion, const SceneFolderSettings& settings = {},
                          const SceneOptions& options = {}) {
  const auto hip = data_folder() / "lhdl-hip";
  const auto coarse = [&](const char* file) { return hip / "coarse" / file; };
  const GeometryPlaces places = {
      {},
      {},
      {{"LHDL_pelvis.vtp", {{coarse("hip_bone_r.ply"), coarse("hip_bone_l.ply"), coarse("sacrum.ply")}, 0.001}},
       {"LHDL_femur_r.vtp", {{coarse("femur_r.ply")}, 0.001}}}};
  const Model model = read_model(hip / "motion/LHDL_hip_r.osim");
  const Table table = read_table(hip / "motion" / (motion + ".mot"));
  return imported(model, places, {motion, coordinate_motion(model, table)}, settings, options);
}

TEST_P(ImportedHip, muscles_miss_no_gate_in_the_models_own_motion) {
  SKIP_WITHOUT_DATA();
  const Scene scene = imported_hip(GetParam());
  ASSERT_EQ(scene.muscles.size(), 8u);
  expect_gates(scene, run_whole(scene));
}

TEST_P(ImportedHip, muscles_that_lie_apart_keep_out_of_each_other_and_miss_no_gate) {
  SKIP_WITHOUT_DATA();
  SceneFolderSettings settings;
  settings.apart = true;
  SceneOptions options;
  options.set = {"contact.muscle=surface"};
  const Scene scene = imported_hip(GetParam(), settings, options);
  ASSERT_EQ(scene.muscles.size(), 8u);
  expect_gates(scene, run_whole(scene));
}

INSTANTIATE_TEST_SUITE_P(Motions, ImportedHip, testing::Values("hip_flexion", "hip_adduction", "hip_rotation"),
                         [](const auto& motion) { return std::string(motion.param); });

/// Muscles of the walking model that are easily led astray: tendons between the foot's bones and around the ankle, ends
/// that move with the patella, points that come and go. A frame every 0.1 s.
static Scene walking(const std::vector<std::string>& muscles, bool in_contact = false, bool merge_heads = false) {
  const auto folder = data_folder() / "opensim";
  const auto path = folder / "subject01_simbody_adjusted_StaticOp.osim";
  const Model model = read_model(path);
  const CoordinateMotion motion = coordinate_motion(model, read_table(folder / "subject01_walk1_Kinematics.sto"));
  SceneFolderSettings settings;
  settings.muscles = muscles;
  SceneOptions options;
  options.set = {"motion.time_step=0.1"};
  settings.apart = in_contact;
  settings.merge_heads = merge_heads;
  if (in_contact) options.set.push_back("contact.muscle=surface");
  return imported(model, {folder, {folder / "geometry"}, {}}, {"walk", motion}, settings, options);
}

TEST(ImportedWalk, muscles_miss_no_gate) {
  SKIP_WITHOUT_DATA();
  const Scene scene = walking({"ext_hal_r", "ext_hal_l", "per_long_r", "tib_post_l", "soleus_r", "med_gas_l",
                               "vas_int_r", "vas_med_r", "rect_fem_r", "tfl_r", "semimem_r", "peri_r", "psoas_r"});
  ASSERT_EQ(scene.muscles.size(), 13u);
  expect_gates(scene, run_whole(scene));
}

TEST(ImportedWalk, heads_made_one_sheet_miss_no_gate) {
  SKIP_WITHOUT_DATA();
  const Scene scene = walking({"glut_max1_r", "glut_max2_r", "glut_max3_r", "glut_med1_r", "glut_med2_r", "glut_med3_r",
                               "glut_min1_r", "glut_min2_r", "glut_min3_r", "add_mag1_r", "add_mag2_r", "add_mag3_r"},
                              false, true);
  ASSERT_EQ(scene.muscles.size(), 4u);
  expect_gates(scene, run_whole(scene));
}

TEST(ImportedWalk, muscles_that_lie_apart_keep_out_of_each_other_and_miss_no_gate) {
  SKIP_WITHOUT_DATA();
  const Scene scene = walking({"semimem_l", "semiten_l", "bifemlh_l", "bifemsh_l", "glut_max1_l", "glut_max2_l",
                               "glut_max3_l", "glut_med1_l", "glut_med2_l", "glut_med3_l"},
                              true);
  ASSERT_EQ(scene.muscles.size(), 10u);
  expect_gates(scene, run_whole(scene));
}

TEST(ImportedWalk, tendons_around_the_ankle_keep_out_of_bellies_and_miss_no_gate) {
  SKIP_WITHOUT_DATA();
  const Scene scene = walking({"med_gas_r", "lat_gas_r", "soleus_r", "tib_post_r", "flex_dig_r", "flex_hal_r",
                               "per_long_r", "per_brev_r", "bifemlh_r", "bifemsh_r", "rect_fem_r", "vas_med_r"},
                              true);
  ASSERT_EQ(scene.muscles.size(), 12u);
  expect_gates(scene, run_whole(scene));
}

TEST(ImportedWalk, a_muscle_over_a_ridge_of_bone_beside_others_misses_no_gate) {
  SKIP_WITHOUT_DATA();
  const Scene scene = walking({"ercspn_l", "ercspn_r", "intobl_l", "extobl_l"}, true);
  ASSERT_EQ(scene.muscles.size(), 4u);
  expect_gates(scene, run_whole(scene));
}

TEST(ImportedPendulum, a_tendon_that_its_line_draws_into_a_belly_keeps_out_of_it) {
  using namespace opensim;
  const auto sized = [](int force, const char* fiber, const char* slack) {
    return "<max_isometric_force>" + std::to_string(force) + "</max_isometric_force><optimal_fiber_length>" + fiber +
           "</optimal_fiber_length><tendon_slack_length>" + slack + "</tendon_slack_length>";
  };
  // 10 mm beside each other; when the rod swings back, the line of the long one comes half the way to the other.
  const Model model = model_from(pendulum(
      muscle("belly", point("/ground", "0.04 0.25 0") + point("rod", "0.04 -0.25 0"), sized(800, "0.3", "0.2")) +
      muscle("tendon", point("/ground", "0.05 0.3 0") + point("rod", "0.05 -0.3 0"), sized(100, "0.05", "0.5"))));
  CoordinateMotion swing{{}, Eigen::VectorXd::LinSpaced(13, 0, -radians(12)), {}};
  for (int i = 0; i < 13; ++i) swing.times.push_back(0.02 * i);
  SceneFolderSettings settings;
  settings.apart = true;
  const TestFolder folder;
  const Scene scene = imported(model, {folder.path(), {}, {}}, {"swing", swing}, settings, {});
  ASSERT_EQ(scene.muscles.size(), 2u);
  expect_gates(scene, run_whole(scene));
}

/// How far the middles of a tendon's sections are beside where the line carries them, at most, m.
static Real tendon_beside_line(const Muscle& muscle, const FrameRecord& record, const Points& now) {
  const LineSections line = line_sections(muscle);
  const PlacedSections rest = sections_at(line, capture_pose(record.frame.pose.bodies.size())),
                       carried = sections_at(line, record.frame.pose);
  const auto middle = [&](const Points& points, Index k) -> Vec3 {
    return points.middleCols(k * muscle.action_line.rays, muscle.action_line.rays).rowwise().mean();
  };
  Real farthest = 0;
  for (Index k = 0; k < static_cast<Index>(line.places.size()); ++k) {
    if (distance_from_tendon(line, k) >= 0) continue;
    const Vec3 was = rest.frame(k).inverse() * middle(muscle.surface.vertices, k),
               is = carried.frame(k).inverse() * middle(now, k);
    farthest = std::max(farthest, (is - was).head<2>().norm());
  }
  return farthest;
}

TEST(ImportedWalk, active_muscles_do_not_draw_their_tendons_off_their_lines) {
  SKIP_WITHOUT_DATA();
  Scene scene = walking({"tib_ant_r", "ext_dig_r", "ext_hal_r", "per_long_r", "soleus_r"});
  for (const Muscle& muscle : scene.muscles) scene.activation.signals.push_back({muscle.name, {0}, {0.3}});
  std::vector<Real> farthest(scene.muscles.size(), 0);
  const auto observe = [&](const FrameRecord& record) {
    for (std::size_t m = 0; m < scene.muscles.size(); ++m)
      farthest[m] = std::max(farthest[m], tendon_beside_line(scene.muscles[m], record, record.frame.muscles[m].points));
  };
  expect_gates(scene, run_whole(scene, 1, observe));
  for (std::size_t m = 0; m < scene.muscles.size(); ++m) EXPECT_LT(farthest[m], 0.01) << scene.muscles[m].name;
}

}  // namespace gracilis
