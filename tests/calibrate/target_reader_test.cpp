#include "calibrate/bent_box.hpp"

#include <gracilis/calibrate/target_reader.hpp>
#include <gracilis/core/errors.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string arms_csv =
    "muscle,coordinate,source,angle_deg,moment_arm_mm\nfront,flexion,mine,0,10\nfront,flexion,mine,1,11\n"
    "front,flexion,mine,5,12\nold_name,flexion,theirs,5,7\n";

struct TargetFolder : SceneFolder {
  TargetFolder() { write("arms.csv", arms_csv); }

  Calibration read(const std::string& text) const { return read_targets(write("targets.toml", text)); }

  std::vector<std::string> problems(const std::string& text) const {
    std::vector<std::string> messages;
    try {
      read(text);
    } catch (const ConfigurationError& error) {
      for (const Problem& problem : error.problems()) messages.push_back(to_string(problem));
    } catch (const InputError& error) {
      for (const Problem& problem : error.problems()) messages.push_back(to_string(problem));
    }
    return messages;
  }

  /// Has one message, which says so.
  void expect_one(const std::string& text, const std::string& said) const {
    const std::vector<std::string> messages = problems(text);
    EXPECT_THAT(messages, ElementsAre(HasSubstr(said))) << text;
    if (!messages.empty()) {
      EXPECT_THAT(messages[0], HasSubstr("targets.toml:"));
    }
  }
};

const std::string target = "[[targets]]\nkind = \"moment_arms\"\nfile = \"arms.csv\"\ncoordinate = \"flexion\"\n";
const std::string parameter = "[[parameters]]\nkey = \"tie_length\"\nbounds = [0.01, 0.1]\n";

}  // namespace

TEST(TargetReader, tables_are_thinned_and_muscles_renamed) {
  const TargetFolder folder;
  const Calibration read =
      folder.read(target + "names = { old_name = \"back\" }\nspacing = 3\ntolerance = 2\nweight = 4\n" + parameter +
                  "scale = \"log\"\nstart = 0.02\n");
  ASSERT_EQ(read.targets.size(), 1u);
  ASSERT_EQ(read.targets[0].parts.size(), 2u);
  EXPECT_EQ(read.targets[0].parts[0].muscle, "front");
  EXPECT_THAT(read.targets[0].parts[0].values, ElementsAre(0.01, 0.012));
  EXPECT_EQ(read.targets[0].parts[1].muscle, "back");
  EXPECT_EQ(read.targets[0].tolerance, 0.002);
  const CalibrationParameter& found = read.parameters.at(0);
  EXPECT_EQ(setting_text(found, place_of_value(found, 0.02)), "0.02");
  EXPECT_EQ(setting_text(found, 1), "0.1");
}

TEST(TargetReader, a_target_one_tolerance_off_adds_its_weight_however_many_values_it_has) {
  const TargetFolder folder;
  const Calibration read =
      folder.read(target + "muscles = [\"front\"]\nspacing = 0\ntolerance = 2\nweight = 4\n" + parameter);
  const Observation off = {{{0.012, 0.009, 0.014}}};
  EXPECT_NEAR(residuals(read.targets, off).squaredNorm(), 4, 1e-9);
  EXPECT_NEAR(target_rms(read.targets[0], off[0]), 0.002, 1e-12);
}

TEST(TargetReader, each_mistake_is_one_message_with_its_place) {
  const TargetFolder folder;
  EXPECT_THAT(folder.problems(target + parameter), ElementsAre());
  folder.expect_one(parameter, "there is nothing to aim at");
  folder.expect_one(target, "there is nothing to change");
  folder.expect_one("[[targets]]\nkind = \"arms\"\n" + parameter, "there is no kind 'arms'");
  folder.expect_one("[[targets]]\nname = \"a\"\n" + parameter, "needs the key 'kind'");
  folder.expect_one(target + "weigth = 2\n" + parameter, "did you mean 'weight'?");
  folder.expect_one(target + "tolerance = 0\n" + parameter, "'tolerance' must be a number from");
  folder.expect_one(target + "range = [5, 1]\n" + parameter, "'range' must begin below its end");
  folder.expect_one(target + "range = [50, 60]\n" + parameter, "tells nothing of 'flexion' in this range");
  folder.expect_one(target + "muscles = [\"fornt\"]\n" + parameter, "did you mean 'front'?");
  folder.expect_one(target + "sources = [\"yours\"]\n" + parameter, "has no source 'yours'");
  folder.expect_one(target + "pose = { flexion = 3 }\n" + parameter, "'flexion' is what moves");
  folder.expect_one(target + "held_out = true\n" + parameter, "all targets are held out");
  folder.expect_one(target + "name = \"a\"\n" + target + "name = \"a\"\n" + parameter, "two targets 'a'");
  folder.expect_one(target + parameter + parameter, "two parameters 'tie_length'");
  folder.expect_one(target + "[[parameters]]\nkey = \"tie_length\"\n", "needs the key 'bounds'");
  folder.expect_one(target + parameter + "start = 1\n", "'start' lies outside of the bounds");
  folder.expect_one(target + "[[parameters]]\nkey = \"a\"\nbounds = [0, 1]\nscale = \"log\"\n", "must begin above 0");
  folder.expect_one(target + parameter + "[search]\nmethod = \"bobyqa\"\n", "bobyqa needs two parameters");
  folder.expect_one(target + parameter + "[search]\nsampling = \"random\"\n", "there is no sampling 'random'");
  folder.expect_one("[[targets]]\nkind = \"volumes\"\n" + parameter, "either 'volumes_cm3' or 'file'");
  folder.expect_one("[[targets]]\nkind = \"shapes\"\nmuscle = \"a\"\nfile = \"none.ply\"\n" + parameter,
                    "'none.ply' is not there");
  folder.write("bad.csv", "muscle,angle_deg,moment_arm_mm\nfront,0,ten\n");
  EXPECT_THAT(folder.problems("[[targets]]\nkind = \"moment_arms\"\nfile = \"bad.csv\"\ncoordinate = \"flexion\"\n" +
                              parameter),
              ElementsAre(HasSubstr("bad.csv:2")));
}

}  // namespace gracilis
