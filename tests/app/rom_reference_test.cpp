#include <gracilis/io/tables/table.hpp>

#include "app/program.hpp"
#include "io/scene_folder.hpp"
#include "opensim/model_texts.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace gracilis {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A muscle 0.3 m beside the axis, 0.4 m below it on the last body.
std::string line_muscle(const std::string& name, const std::string& place = "0 -0.4 0") {
  return opensim::muscle(name, opensim::point("/ground", "0.3 0 0") + opensim::point("/bodyset/rod", place));
}

/// Two bodies that turn about the same axis, one on the other: arms about flexion are those at the sum of both angles.
std::string line_model(const std::string& muscles, const std::string& first = "flexion") {
  const std::string hip = opensim::joint("PinJoint", "hip", "/ground", "link", opensim::coordinate(first));
  const std::string twist =
      opensim::joint("PinJoint", "twist", "/bodyset/link", "rod", opensim::coordinate("rotation"));
  return opensim::document(opensim::set("BodySet", opensim::body("link") + opensim::body("rod")) +
                           opensim::set("JointSet", hip + twist) + opensim::set("ForceSet", muscles));
}

Real arm_at(Real angle) { return 0.12 * std::cos(angle) / std::sqrt(0.25 - 0.24 * std::sin(angle)); }

/// Boxes about a joint of two axes, captured at a flexion of 2 and a rotation of 3 degrees, beside a model.
class RomReference : public testing::Test {
 protected:
  RomReference() { setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1); }

  ProgramResult rom(const std::string& model, const std::string& muscle = "muscle",
                    const std::string& more = "") const {
    const std::string rotation =
        "[[joints.axes]]\ncoordinate = \"rotation\"\naxis = [0, 0, 1]\ncapture_deg = 3\n[[muscles]]";
    const std::string scene = with(good_scene(), "[[muscles]]", rotation);
    folder.write("scene.toml", with(scene, "name = \"muscle\"", "name = \"" + muscle + "\""));
    folder.write("line.osim", model);
    return run_program("rom " + folder.path("scene.toml").string() + " --set method=skinning --set fibers.count=3" +
                       " --tables-only --force --out " + folder.path("out").string() +
                       " --coord flexion=-4:4:2 --reference " + folder.path("line.osim").string() + " " + more);
  }

  /// Root mean square distance of our arms from those of the model while its rotation is so many degrees, mm.
  Real distance_at(Real rotation) const {
    const Table table = read_table(folder.path("out/moment_arms.sto"));
    const Eigen::Index flexion = column_of(table, "flexion").value(), muscle = column_of(table, "muscle").value();
    Real squares = 0;
    for (Eigen::Index row = 0; row < 5; ++row)
      squares += std::pow(table.values(row, muscle) - arm_at(radians(table.values(row, flexion) + rotation)), 2);
    return 1e3 * std::sqrt(squares / 5);
  }

  std::string told() const {
    std::ifstream file(folder.path("out/reference.csv"));
    std::string head, row;
    std::getline(file, head), std::getline(file, row);
    return row;
  }

  SceneFolder folder;
};

TEST_F(RomReference, of_a_line_model_is_drawn_and_measured_in_the_pose_of_the_scene) {
  const std::string muscles = line_muscle("muscle") + line_muscle("other") + line_muscle("still", "0 0 0");
  const std::string row = "muscle,line,5,-4.00,4.00,";
  const ProgramResult result = rom(line_model(muscles));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("beside line: "));
  EXPECT_THAT(result.err, HasSubstr("line: left out, since the scene has no such muscle: other\n"));
  ASSERT_TRUE(told().starts_with(row)) << told();
  EXPECT_NEAR(std::stod(told().substr(row.size())), distance_at(3), 1e-3);
  std::ifstream chart(folder.path("out/plots/moment_arms_muscle.svg"));
  EXPECT_THAT(std::string(std::istreambuf_iterator<char>(chart), {}),
              HasSubstr(fmt::format(">line, {:.1f} mm RMS<", distance_at(3))));

  const nlohmann::json told_as_json = nlohmann::json::parse(rom(line_model(muscles), "muscle", "--json").out);
  const nlohmann::json& muscle = told_as_json.at("muscles").at(0);
  EXPECT_EQ(muscle.at("coordinate"), "flexion");
  EXPECT_LE(muscle.at("least_mm"), muscle.at("most_mm"));
  EXPECT_EQ(muscle.at("beside").at(0).at("source"), "line");
  EXPECT_NEAR(muscle.at("beside").at(0).at("rms_mm").get<double>(), distance_at(3), 1e-9);

  ASSERT_EQ(rom(line_model(muscles), "muscle", "--coord rotation=20").exit_code, 0);
  EXPECT_NEAR(std::stod(told().substr(row.size())), distance_at(20), 1e-3);
}

TEST_F(RomReference, parts_of_a_muscle_by_other_names_are_each_drawn_beside_it) {
  const std::string muscles = line_muscle("glut_max1_r") + line_muscle("glut_max2_r", "0 -0.3 0") +
                              line_muscle("glut_max1_l") + line_muscle("glut_med1_r");
  const ProgramResult result = rom(line_model(muscles), "gluteus_maximus_r");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("beside line glut_max1_r: "));
  EXPECT_THAT(result.out, HasSubstr("beside line glut_max2_r: "));
  EXPECT_THAT(result.out, HasSubstr("beyond the band of all 2"));
  EXPECT_THAT(result.err, HasSubstr("no such muscle: glut_max1_l, glut_med1_r\n"));
}

TEST_F(RomReference, a_muscle_of_the_same_name_is_the_only_one) {
  const ProgramResult result =
      rom(line_model(line_muscle("glut_max1_r") + line_muscle("gluteus_maximus_r")), "gluteus_maximus_r");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("beside line: "));
  EXPECT_THAT(result.out, Not(HasSubstr("beside line glut_max1_r")));
}

TEST_F(RomReference, of_a_model_without_the_coordinate_is_refused_before_it_runs) {
  const ProgramResult result = rom(line_model(line_muscle("muscle"), "flexon"));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("line.osim"));
  EXPECT_THAT(result.err, HasSubstr("has no coordinate 'flexion'"));
  EXPECT_THAT(result.err, HasSubstr("did you mean 'flexon'?"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("out")));
}

}  // namespace
}  // namespace gracilis
