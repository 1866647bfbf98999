#include "opensim/model_texts.hpp"

#include <gracilis/geometry/sobol_points.hpp>
#include <gracilis/opensim/export/path_fit.hpp>
#include <gracilis/opensim/export/run_paths.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

static Real length_at(Real a, Real b) { return 0.3 + 0.02 * a - 0.015 * a * b + 0.01 * b * b; }

static PathSamples grid_samples() {
  PathSamples samples{Eigen::MatrixXd(49, 2), Eigen::VectorXd(49)};
  for (int i = 0; i < 49; ++i) {
    samples.coordinates.row(i) << -0.6 + 0.2 * (i / 7), -0.3 + 0.1 * (i % 7);
    samples.lengths[i] = length_at(samples.coordinates(i, 0), samples.coordinates(i, 1));
  }
  return samples;
}

TEST(PathFit, a_polynomial_of_two_coordinates_is_found_again) {
  const PathFit fit = fit_path(grid_samples());
  EXPECT_EQ(fit.function.order, 2);
  EXPECT_LT(fit.held_out.length_largest, 1e-8);
  EXPECT_NEAR(value(fit.function, {0.25, -0.12}), length_at(0.25, -0.12), 1e-8);
  EXPECT_NEAR(derivative(fit.function, {0.25, -0.12}, {0}), 0.02 + 0.015 * 0.12, 1e-7);
}

TEST(PathFit, noise_does_not_raise_the_order) {
  PathSamples samples{Eigen::MatrixXd(60, 1), Eigen::VectorXd(60)};
  for (int i = 0; i < 60; ++i) {
    samples.coordinates(i, 0) = 0.03 * i;
    samples.lengths[i] = 0.2 + 0.05 * samples.coordinates(i, 0) + 1e-4 * std::sin(1000.0 * i * i);
  }
  EXPECT_LE(fit_path(samples).function.order, 2);
}

TEST(PathFit, few_rows_allow_few_terms) {
  PathSamples samples{Eigen::MatrixXd(5, 1), Eigen::VectorXd(5)};
  for (int i = 0; i < 5; ++i) samples.lengths[i] = std::exp(samples.coordinates(i, 0) = 0.3 * i);
  EXPECT_LE(fit_path(samples).function.order, 1);
}

TEST(PathFit, arms_are_fitted_together_with_lengths) {
  // Lengths along one line of poses say nothing about the direction across it; arms do.
  PathSamples samples{Eigen::MatrixXd(30, 2), Eigen::VectorXd(30), Eigen::MatrixXd(30, 2)};
  for (int i = 0; i < 30; ++i) {
    const Real a = -0.5 + i / 29.0, b = 2 * a;
    samples.coordinates.row(i) << a, b;
    samples.lengths[i] = length_at(a, b);
    samples.arms.row(i) << -(0.02 - 0.015 * b), -(-0.015 * a + 0.02 * b);
  }
  const PathFit fit = fit_path(samples);
  EXPECT_LT(fit.held_out.arm_largest, 1e-7);
  EXPECT_NEAR(derivative(fit.function, {0.3, 0.6}, {1}), -0.015 * 0.3 + 0.02 * 0.6, 1e-7);
}

TEST(PathFit, arms_of_the_written_polynomial_are_those_that_errors_are_told_of) {
  PathSamples samples = grid_samples();
  const Function function = fit_path(samples).function;
  samples.arms = Eigen::MatrixXd::Zero(49, 2);
  Real largest = 0;
  for (Eigen::Index row = 0; row < 49; ++row)
    for (int i = 0; i < 2; ++i)
      largest = std::max(
          largest, std::abs(derivative(function, {samples.coordinates(row, 0), samples.coordinates(row, 1)}, {i})));
  EXPECT_NEAR(path_errors(function, samples).arm_largest, largest, 1e-12);
}

TEST(PathFit, what_samples_do_not_say_is_drawn_to_what_is_given) {
  PathSamples samples{Eigen::MatrixXd(20, 2), Eigen::VectorXd(20)};
  for (int i = 0; i < 20; ++i) {
    samples.coordinates.row(i) << 0.05 * i, 0.05 * i;  // the two go together
    samples.lengths[i] = 0.01 * 0.05 * i;
  }
  PathFitSettings settings;
  settings.largest_order = 1;
  settings.ridges = {1e-3};
  const Eigen::MatrixXd poses = sobol_points(64, 2);
  settings.towards = {poses, Eigen::VectorXd::Zero(64), Eigen::MatrixXd::Zero(64, 2)};
  const PathFit fit = fit_path(samples, settings);
  EXPECT_NEAR(derivative(fit.function, {0.5, 0.5}, {0}), 0.005, 1e-4);  // shared equally, not by chance
  EXPECT_NEAR(derivative(fit.function, {0.5, 0.5}, {1}), 0.005, 1e-4);
}

TEST(PathFit, sums_of_polynomials_of_different_order_add_up) {
  const Function a = fit_path(grid_samples()).function;
  Function b;
  b.kind = Function::Kind::multivariate;
  b.dimension = 2;
  b.order = 1;
  b.coefficients = {0.5, -1, 2};
  EXPECT_NEAR(value(sum_of(a, b), {0.2, 0.1}), value(a, {0.2, 0.1}) + 0.5 - 0.1 + 0.4, 1e-12);
}

/// A run's table: two angles in degrees, of which the second one does nothing to the muscle.
static std::string lengths_table() {
  std::string text =
      "fiber_lengths\nversion=1\nnRows=21\nnColumns=5\ninDegrees=yes\nendheader\ntime\tswing\tother\tm\tm_f000\n";
  for (int i = 0; i < 21; ++i) {
    const Real swing = -30.0 + 3 * i, length = std::sqrt(0.25 - 0.24 * std::sin(radians(swing)));
    text += fmt::format("{}\t{}\t{}\t{}\t{}\n", i, swing, (i * 7) % 5, length, length);
  }
  return text;
}

static const char* const joints =
    R"({"scene": "s", "settings": "", "joints": [{"name": "hinge", "coordinates": [
    {"name": "swing", "translation": false},
    {"name": "other", "translation": false}, {"name": "hinge_translation1", "translation": true},
    {"name": "slide", "translation": true}]}]})";

TEST(RunLengths, without_a_model_the_scene_s_joints_name_the_coordinates) {
  const TestFolder folder;
  folder.write("fiber_lengths.sto", lengths_table());
  folder.write("run.json", joints);
  const Model model = joints_of_run(folder.path());
  ASSERT_EQ(model.coordinates.size(), 3u);  // hinge_translation1 is none: it follows others
  EXPECT_EQ(coordinate_path(model, 0), "/jointset/hinge/swing");
  const FittedMuscles fitted = fit_muscles(run_lengths(folder.path(), model), model);
  ASSERT_EQ(fitted.muscles.size(), 1u);
  EXPECT_EQ(fitted.muscles[0].coordinates, std::vector<Index>{0});
  for (const Real swing : {-0.4, 0.0, 0.3}) {
    const Real length = std::sqrt(0.25 - 0.24 * std::sin(swing));
    EXPECT_NEAR(value(fitted.muscles[0].length, {swing}), length, 1e-5);
    EXPECT_NEAR(-derivative(fitted.muscles[0].length, {swing}, {0}), 0.12 * std::cos(swing) / length, 1e-3);
  }
}

TEST(RunLengths, lengths_among_the_coordinates_are_no_angles) {
  const TestFolder folder;
  std::string text =
      "fiber_lengths\nversion=1\nnRows=9\nnColumns=4\ninDegrees=yes\nendheader\ntime\tslide\tm\tm_f000\n";
  for (int i = 0; i < 9; ++i) text += fmt::format("{}\t{}\t{}\t{}\n", i, 0.01 * i, 0.3 + 0.02 * i, 0.3 + 0.02 * i);
  folder.write("fiber_lengths.sto", text);
  folder.write("run.json", joints);
  const Model model = joints_of_run(folder.path());
  const FittedMuscles fitted = fit_muscles(run_lengths(folder.path(), model), model);
  ASSERT_EQ(fitted.muscles.size(), 1u);
  EXPECT_NEAR(derivative(fitted.muscles[0].length, {0.03}, {0}), 2, 1e-6);
}

TEST(RunLengths, arms_about_what_follows_a_coordinate_count_as_the_model_says) {
  // The scene has a translation of its own, slide = 0.5 swing in the model.
  const std::string moved =
      "<SpatialTransform><TransformAxis name=\"rotation1\"><coordinates>swing</coordinates><axis>0 0 1</axis>"
      "<LinearFunction><coefficients>1 0</coefficients></LinearFunction></TransformAxis>"
      "<TransformAxis name=\"translation1\"><coordinates>swing</coordinates><axis>1 0 0</axis>"
      "<LinearFunction><coefficients>0.5 0</coefficients></LinearFunction></TransformAxis></SpatialTransform>";
  const Model model =
      model_from(document(set("BodySet", body("rod")) + set("JointSet", joint("CustomJoint", "hinge", "/ground", "rod",
                                                                              coordinate("swing"), moved))));
  const TestFolder folder;
  folder.write("fiber_lengths.sto", lengths_table());
  const auto arms = [](const std::string& name, Real arm) {
    std::string text = name + "\nversion=1\nnRows=21\nnColumns=4\ninDegrees=yes\nendheader\ntime\tswing\tm\tm_f000\n";
    for (int i = 0; i < 21; ++i) text += fmt::format("{}\t0\t{}\t{}\n", i, arm, arm);
    return text;
  };
  folder.write("moment_arms_swing.sto", arms("a", 0.03));
  folder.write("moment_arms_hinge_translation1.sto", arms("b", 0.01));
  const LengthSamples run = run_lengths(folder.path(), model);
  ASSERT_EQ(run.muscles[0].arms.cols(), 1);
  EXPECT_NEAR(run.muscles[0].arms(4, 0), 0.03 + 0.5 * 0.01, 1e-12);
}

TEST(RunLengths, a_run_that_does_not_move_is_refused) {
  const TestFolder folder;
  folder.write("fiber_lengths.sto",
               "f\nversion=1\nnRows=1\nnColumns=4\ninDegrees=yes\nendheader\ntime\tswing\tm\tm_f000\n0\t0\t1\t1\n");
  folder.write("run.json", joints);
  const Model model = joints_of_run(folder.path());
  EXPECT_THAT(message_of_input_error([&] { run_lengths(folder.path(), model); }),
              testing::HasSubstr("no motion to fit"));
}

TEST(RunLengths, joints_of_another_shape_are_an_error_that_names_the_file) {
  const TestFolder folder;
  for (const char* wrong :
       {"[{\"name\": 5}]", "[7]", "{\"hinge\": 1}", "[{\"coordinates\": 3}]", "[{\"coordinates\": [{\"name\": []}]}]",
        "[{\"coordinates\": [{\"translation\": \"no\"}]}]"}) {
    folder.write("run.json", std::string("{\"joints\": ") + wrong + "}");
    EXPECT_THAT(message_of_input_error([&] { joints_of_run(folder.path()); }), testing::HasSubstr("run.json")) << wrong;
  }
}

}  // namespace gracilis::opensim
