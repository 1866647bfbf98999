#include <gracilis/methods/xpbd/mid_solve_snapshot.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>

namespace gracilis {
namespace {

/// What one iteration makes of the tube in the middle of a step.
std::uint64_t hash_of_an_iteration(const XpbdSettings& settings) {
  const Scene scene = tube_scene(settings);
  std::vector<Pose> poses;
  for (int degree = 0; degree <= 10; ++degree) poses.push_back(flexed(scene, radians(degree)));
  const xpbd::MidSolveSnapshot muscle = xpbd::mid_solve_snapshot(scene, scene.muscles[0], tube_fields(), poses);
  return xpbd::time_projection(muscle, std::nullopt, 1).hash;
}

}  // namespace

TEST(MidSolveSnapshot, every_setting_of_the_solver_reaches_what_is_timed) {
  const std::map<std::string, std::function<void(XpbdSettings&)>> changes = {
      {"dihedral_formula", [](XpbdSettings& s) { s.dihedral_formula = DihedralFormula::arccos; }},
      {"pressure", [](XpbdSettings& s) { s.pressure = 1.05; }},
      {"rayleigh_beta", [](XpbdSettings& s) { s.rayleigh_beta = 0.01; }},
      {"constraint_time_step", [](XpbdSettings& s) { s.constraint_time_step = 0.1; }},
      {"time_step", [](XpbdSettings& s) { s.time_step = 0.1; }},
      {"substeps", [](XpbdSettings& s) { s.substeps = 4; }},
      {"predictor", [](XpbdSettings& s) { s.predictor = Predictor::none; }},
      {"hinge_limit", [](XpbdSettings& s) { s.dihedral_limit = 0.001; }},
      {"stretch_limit", [](XpbdSettings& s) { s.stretch_limit = 1.01; }}};
  const std::uint64_t unchanged = hash_of_an_iteration({});
  EXPECT_EQ(hash_of_an_iteration({}), unchanged);
  for (const auto& [key, change] : changes) {
    XpbdSettings settings;
    change(settings);
    EXPECT_NE(hash_of_an_iteration(settings), unchanged) << key;
  }
}

}  // namespace gracilis
