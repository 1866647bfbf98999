#include "opensim/model_texts.hpp"

#include <gracilis/io/input_file.hpp>
#include <gracilis/opensim/export/run_paths.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

static Real length_at(Real a, Real b) { return 0.3 + 0.02 * a - 0.015 * a * b + 0.01 * b * b; }

TEST(PathFit, a_polynomial_of_two_coordinates_is_found_again) {
  Eigen::MatrixXd coordinates(49, 2);
  Eigen::VectorXd lengths(49);
  for (int i = 0; i < 49; ++i) {
    coordinates.row(i) << -0.6 + 0.2 * (i / 7), -0.3 + 0.1 * (i % 7);
    lengths[i] = length_at(coordinates(i, 0), coordinates(i, 1));
  }
  const PathFit fit = fit_path(coordinates, lengths);
  EXPECT_EQ(fit.function.order, 2);
  EXPECT_LT(fit.largest, 1e-12);
  EXPECT_NEAR(value(fit.function, {0.25, -0.12}), length_at(0.25, -0.12), 1e-12);
  EXPECT_NEAR(derivative(fit.function, {0.25, -0.12}, {0}), 0.02 + 0.015 * 0.12, 1e-11);
}

TEST(PathFit, noise_does_not_raise_the_order) {
  Eigen::MatrixXd coordinates(60, 1);
  Eigen::VectorXd lengths(60);
  for (int i = 0; i < 60; ++i) {
    coordinates(i, 0) = 0.03 * i;
    lengths[i] = 0.2 + 0.05 * coordinates(i, 0) + 1e-4 * std::sin(1000.0 * i * i);
  }
  EXPECT_LE(fit_path(coordinates, lengths).function.order, 2);
}

TEST(PathFit, few_rows_allow_few_terms) {
  Eigen::MatrixXd coordinates(5, 1);
  Eigen::VectorXd lengths(5);
  for (int i = 0; i < 5; ++i) lengths[i] = std::exp(coordinates(i, 0) = 0.3 * i);
  EXPECT_LE(fit_path(coordinates, lengths).function.order, 1);
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

TEST(RunPaths, a_model_with_the_fitted_paths_has_the_runs_lengths) {
  const TestFolder folder;
  folder.write("fiber_lengths.sto", lengths_table());
  const std::vector<std::string> lines = export_function_paths(folder.path(), folder.path() / "paths.xml");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(lines[0], testing::HasSubstr("in swing;"));
  const std::string written = read_text(folder.path() / "paths.xml");
  const std::size_t begin = written.find("<FunctionBasedPath "), end = written.find("</FunctionBasedPath>") + 20;
  const Model model =
      model_from(pendulum("<Millard2012EquilibriumMuscle name=\"m\"><path>" + written.substr(begin, end - begin) +
                          "</path></Millard2012EquilibriumMuscle>"));
  Skeleton skeleton(model);
  for (const Real swing : {-0.4, 0.0, 0.3}) {
    const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, swing);
    skeleton.place(q);
    const PathMeasure measure = measure_path(skeleton, model.muscles[0].path, q);
    const Real length = std::sqrt(0.25 - 0.24 * std::sin(swing));
    EXPECT_NEAR(measure.length, length, 1e-5);
    EXPECT_NEAR(measure.moment_arms[0], 0.12 * std::cos(swing) / length, 1e-3);
  }
}

TEST(RunPaths, lengths_among_the_coordinates_are_no_angles) {
  const TestFolder folder;
  std::string text =
      "fiber_lengths\nversion=1\nnRows=9\nnColumns=4\ninDegrees=yes\nendheader\ntime\tslide\tm\tm_f000\n";
  for (int i = 0; i < 9; ++i) text += fmt::format("{}\t{}\t{}\t{}\n", i, 0.01 * i, 0.3 + 0.02 * i, 0.3 + 0.02 * i);
  folder.write("fiber_lengths.sto", text);
  folder.write("measures.csv", "frame,time_s,slide_mm,muscle,volume_ratio\n");
  const std::vector<FittedMuscle> muscles = fit_run(folder.path());
  ASSERT_EQ(muscles.size(), 1u);
  EXPECT_NEAR(derivative(muscles[0].fit.function, {0.03}, {0}), 2, 1e-9);
}

TEST(RunPaths, a_run_that_does_not_move_is_refused) {
  const TestFolder folder;
  folder.write("fiber_lengths.sto",
               "f\nversion=1\nnRows=1\nnColumns=4\ninDegrees=yes\nendheader\ntime\ta\tm\tm_f000\n0\t0\t1\t1\n");
  EXPECT_THAT(message_of_input_error([&] { fit_run(folder.path()); }), testing::HasSubstr("no motion to fit"));
}

}  // namespace gracilis::opensim
