#include <gracilis/study/design.hpp>
#include <gracilis/study/sensitivity.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace gracilis {

namespace {

Sampling sampling_of(SamplingKind kind, Index samples, std::vector<std::uint64_t> seeds = {1}) {
  return {kind, samples, std::move(seeds), 4};
}

/// A study whose runs have these places as values of their parameters.
Study study_of(const Sampling& sampling, Index columns) {
  Study study;
  study.sampling = sampling;
  study.points = design_points(sampling, columns, {}, {});
  for (Index column = 0; column < columns; ++column) study.parameters.push_back("x" + std::to_string(column));
  for (Index row = 0; row < study.points.rows(); ++row) {
    StudyRun run;
    for (Index column = 0; column < columns; ++column) run.values.push_back(std::to_string(study.points(row, column)));
    study.runs.push_back(run);
  }
  return study;
}

template <class Function>
std::vector<Real> values_of(const Study& study, Function&& function) {
  std::vector<Real> values;
  for (Index row = 0; row < study.points.rows(); ++row) values.push_back(function(study.points.row(row)));
  return values;
}

}  // namespace

TEST(Design, a_grid_has_every_combination_once_the_last_column_first) {
  const Eigen::MatrixXd points = design_points({SamplingKind::grid, 0, {1}, 4}, 2, {2, 3}, {false, true});
  ASSERT_EQ(points.rows(), 6);
  EXPECT_EQ(points.row(0), Eigen::RowVector2d(0, 0.5 / 3));
  EXPECT_EQ(points.row(1), Eigen::RowVector2d(0, 1.5 / 3));
  EXPECT_EQ(points.row(5), Eigen::RowVector2d(1, 2.5 / 3));
}

TEST(Design, more_samples_of_a_sequence_keep_those_that_were_there) {
  for (const SamplingKind kind : {SamplingKind::halton, SamplingKind::sobol, SamplingKind::indices}) {
    const Eigen::MatrixXd few = design_points(sampling_of(kind, 5), 3, {}, {}),
                          more = design_points(sampling_of(kind, 9), 3, {}, {});
    EXPECT_EQ(few, more.topRows(few.rows()));
  }
}

TEST(Design, seeds_give_one_design_after_the_other) {
  const Eigen::MatrixXd both = design_points(sampling_of(SamplingKind::latin, 7, {3, 4}), 2, {}, {});
  ASSERT_EQ(both.rows(), 14);
  EXPECT_EQ(both.bottomRows(7), design_points(sampling_of(SamplingKind::latin, 7, {4}), 2, {}, {}));
  EXPECT_NE(both.topRows(7), both.bottomRows(7));
}

TEST(Design, a_way_of_morris_changes_every_column_once_by_two_thirds) {
  const Eigen::MatrixXd points = design_points(sampling_of(SamplingKind::morris, 20), 3, {}, {});
  ASSERT_EQ(points.rows(), 80);
  EXPECT_GE(points.minCoeff(), 0);
  EXPECT_LE(points.maxCoeff(), 1 + 1e-12);
  for (Index way = 0; way < 20; ++way) {
    std::set<Index> changed;
    for (Index i = 0; i < 3; ++i) {
      const Eigen::RowVectorXd step = points.row(4 * way + i + 1) - points.row(4 * way + i);
      Index column = 0;
      EXPECT_NEAR(step.cwiseAbs().maxCoeff(&column), 2.0 / 3, 1e-12);
      EXPECT_NEAR(step.cwiseAbs().sum(), 2.0 / 3, 1e-12);
      changed.insert(column);
    }
    EXPECT_EQ(changed.size(), 3u);
  }
}

TEST(Sensitivities, elementary_effects_of_a_plane_are_its_slopes) {
  const Study study = study_of(sampling_of(SamplingKind::morris, 5), 3);
  const std::vector<Sensitivity> found =
      sensitivities(study, values_of(study, [](const auto& x) { return 3 * x[0] - 2 * x[1]; }));
  EXPECT_NEAR(found[0].first, 3, 1e-9);
  EXPECT_NEAR(found[1].first, 2, 1e-9);
  EXPECT_NEAR(found[2].first, 0, 1e-9);
  EXPECT_NEAR(found[0].second, 0, 1e-9);
  EXPECT_EQ(found[0].count, 5);
}

TEST(Sensitivities, a_failed_run_takes_its_effects_along_and_no_others) {
  const Study study = study_of(sampling_of(SamplingKind::morris, 5), 2);
  std::vector<Real> values = values_of(study, [](const auto& x) { return x[0] + x[1]; });
  values[1] = std::nan("");  // the middle of the first way
  const std::vector<Sensitivity> found = sensitivities(study, values);
  EXPECT_EQ(found[0].count, 4);
  EXPECT_NEAR(found[1].first, 1, 1e-9);
}

/// Ishigami's function (a = 7, b = 0.1), whose indices are known in closed form (Saltelli et al. 2000).
TEST(Sensitivities, indices_of_ishigamis_function_are_those_known) {
  const Study study = study_of(sampling_of(SamplingKind::indices, 4096), 3);
  const std::vector<Sensitivity> found = sensitivities(
      study, values_of(study, [](const auto& x) {
        const Real pi = std::acos(-1.0), a = pi * (2 * x[0] - 1), b = pi * (2 * x[1] - 1), c = pi * (2 * x[2] - 1);
        return std::sin(a) + 7 * std::sin(b) * std::sin(b) + 0.1 * std::pow(c, 4) * std::sin(a);
      }));
  // 4096 of Sobol's points: errors of about 1 %.
  EXPECT_NEAR(found[0].first, 0.314, 0.02);
  EXPECT_NEAR(found[1].first, 0.442, 0.02);
  EXPECT_NEAR(found[2].first, 0, 0.02);
  EXPECT_NEAR(found[0].second, 0.558, 0.02);
  EXPECT_NEAR(found[1].second, 0.442, 0.02);
  EXPECT_NEAR(found[2].second, 0.244, 0.02);
}

TEST(Sensitivities, ranks_see_through_a_curve) {
  const Study study = study_of(sampling_of(SamplingKind::latin, 30), 2);
  const std::vector<Sensitivity> found =
      sensitivities(study, values_of(study, [](const auto& x) { return -std::exp(5 * x[0]); }));
  EXPECT_NEAR(found[0].first, -1, 1e-12);
  EXPECT_LT(std::abs(found[1].first), 0.5);
}

}  // namespace gracilis
