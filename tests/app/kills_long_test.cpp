#include <gracilis/io/scene/data_root.hpp>

#include "app/killed_runs.hpp"

namespace gracilis {
namespace {

class ManyKilledRuns : public KilledRuns {
 protected:
  /// The picture at the end takes most of a short run's time, and hence most kills; without a driver there is none.
  static void draw_nothing() { setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nowhere", 1); }
};

TEST_F(ManyKilledRuns, of_boxes_end_as_if_nobody_had_killed_them) {
  expect_nothing_lost("run " + folder.write("scene.toml", good_scene()).string() + " --set fibers.count=3", 30);
}

TEST_F(ManyKilledRuns, of_boxes_do_where_nothing_is_drawn) {
  draw_nothing();
  expect_nothing_lost("run " + folder.write("scene.toml", good_scene()).string() + " --set fibers.count=3", 60);
}

TEST_F(ManyKilledRuns, of_boxes_in_dynamic_mode_and_compact_files_do_too) {
  const std::string scene = folder.write("scene.toml", good_scene()).string();
  draw_nothing();
  expect_nothing_lost("run " + scene + " --set time_mode=dynamic --layout compact", 40);
}

TEST_F(ManyKilledRuns, of_the_built_in_hip_do_too) {
  draw_nothing();
  expect_nothing_lost("demo --flexion 8 --step 2 --preset fast --only iliacus_r --only adductor_longus_r", 50);
}

TEST_F(ManyKilledRuns, of_the_cadavers_hip_do_too) {
  const std::filesystem::path scene =
      std::filesystem::path(build_paths::source_folder) / "scenes" / "lhdl_hip" / "flexion_60.toml";
  if (find_data_root(scene, {}).empty()) GTEST_SKIP() << "the cadaver's data are not here: set GRACILIS_DATA";
  draw_nothing();
  expect_nothing_lost("run " + scene.string() + " --set preset=fast --set motion.step_deg=10 --only psoas_major_r", 20);
}

}  // namespace
}  // namespace gracilis
