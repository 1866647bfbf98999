#include <gracilis/calibrate/calibration_files.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>

#include "io/scene_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {

namespace {

using testing::HasSubstr;

/// A scene that has the number x as a length, in m, which is aimed at, and again held out.
Calibration two_lengths(Real aim) {
  Calibration calibration;
  CalibrationTarget seen;
  seen.name = "seen";
  seen.kind = TargetKind::lengths;
  seen.parts = {{"psoas", "", {0, 0.1}, {aim, aim}, nullptr}};
  CalibrationTarget held_out = seen;
  held_out.name = "judged";
  held_out.held_out = true;
  calibration.targets = {seen, held_out};
  CalibrationParameter x;
  x.setting.key = "x";
  x.setting.low = 0;
  x.setting.high = 1;
  calibration.parameters = {x};
  return calibration;
}

Real x_of(const std::vector<std::string>& set) { return std::stod(set.at(0).substr(2)); }

CalibrationResult calibrated(const SceneFolder& folder, const Calibration& calibration, const ObserveFunction& observe,
                             std::vector<std::string>& said) {
  SceneMatch match;
  match.starts = {0.5};
  match.whole = {0};
  CalibrationOptions options;
  options.folder = folder.path("out");
  options.say = [&](const std::string& line) { said.push_back(line); };
  return run_calibration(calibration, match, observe, options);
}

}  // namespace

TEST(RunCalibration, what_is_held_out_and_fails_at_the_best_point_is_left_blank_with_a_remark) {
  const SceneFolder folder;
  std::vector<std::string> said;
  const CalibrationResult result = calibrated(
      folder, two_lengths(0.9),
      [](const std::vector<std::string>& set, const std::vector<CalibrationTarget>& targets) -> Observation {
        if (targets[0].held_out && x_of(set) > 0.7) throw QualityError("it explodes");
        return {{{x_of(set), x_of(set)}}};
      },
      said);
  EXPECT_NEAR(std::stod(result.best_values[0]), 0.9, 1e-3);
  EXPECT_EQ(result.before[1][0][0], 0.5);
  EXPECT_TRUE(std::isnan(result.after[1][0][0]));
  EXPECT_THAT(said, testing::Contains(HasSubstr("judged is left blank, for it cannot be evaluated at the best point")));
  write_calibration_files(folder.path("out"), result, {});
  EXPECT_THAT(read_text(folder.path("out/calibrated.toml")), HasSubstr("x = " + result.best_values[0]));
  const std::string fit = read_text(folder.path("out/fit.csv"));
  EXPECT_THAT(fit, HasSubstr("seen,no,psoas,,0.0000,900.0000,500.0000,"));
  EXPECT_THAT(fit, HasSubstr("judged,yes,psoas,,0.0000,900.0000,500.0000,,mm,cannot be evaluated at the best point: "));
}

TEST(RunCalibration, a_folder_of_somebody_else_is_left_alone_even_by_force) {
  const SceneFolder folder;
  folder.write("out/definition.txt", "what I mean by a sprint");
  folder.write("out/evaluations/mine.txt", "precious");
  CalibrationOptions options;
  options.folder = folder.path("out");
  options.force = true;
  const ObserveFunction observe = [](const std::vector<std::string>& set, const std::vector<CalibrationTarget>&) {
    return Observation{{{x_of(set), x_of(set)}}};
  };
  SceneMatch match;
  match.starts = {0.5};
  match.whole = {0};
  EXPECT_THROW(run_calibration(two_lengths(0.9), match, observe, options), ConfigurationError);
  EXPECT_EQ(read_text(folder.path("out/evaluations/mine.txt")), "precious");
  EXPECT_EQ(read_text(folder.path("out/definition.txt")), "what I mean by a sprint");
}

TEST(RunCalibration, a_start_that_is_not_finite_is_told_and_not_searched_from) {
  for (const Index samples : {0, 4}) {
    const SceneFolder folder;
    Calibration calibration = two_lengths(0.9);
    calibration.search.samples = samples;
    std::vector<std::string> said;
    EXPECT_THROW(calibrated(
                     folder, calibration,
                     [](const auto&, const auto&) -> Observation {
                       return {{{std::nan(""), 0}}};
                     },
                     said),
                 QualityError);
    EXPECT_EQ(said.size(), 1u) << "one evaluation";
  }
}

}  // namespace gracilis
