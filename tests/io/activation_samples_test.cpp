#include <gracilis/io/tables/activation_samples.hpp>

#include <gracilis/core/errors.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>

namespace gracilis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Table table_of(const std::vector<std::string>& columns, const std::vector<Real>& times, const Eigen::MatrixXd& values) {
  Table table;
  table.name = "table";
  table.columns = columns;
  table.times = times;
  table.values = values;
  table.in_degrees = true;
  return table;
}

/// Three instants; two parts of one muscle and a residual actuator.
Trial trial() {
  Trial trial;
  trial.name = "walk";
  trial.motion = table_of({"hip_flexion_r", "pelvis_tx"}, {0, 0.1, 0.2},
                          (Eigen::MatrixXd(3, 2) << 10, 1, 20, 1, 30, 1).finished());
  trial.activations = table_of({"glut_max1_r", "glut_max2_r", "FX"}, {0, 0.1, 0.2},
                               (Eigen::MatrixXd(3, 3) << 0.1, 0.3, -5, 0.6, 0.8, 5, 0.2, 0.2, 0).finished());
  trial.forces = table_of({"glut_max1_r", "glut_max2_r"}, {0, 0.1, 0.2},
                          (Eigen::MatrixXd(3, 2) << 100, 300, 0, 0, 50, 50).finished());
  return trial;
}

std::vector<Real> column(const Table& table, Index i) {
  return {table.values.col(i).begin(), table.values.col(i).end()};
}

}  // namespace

TEST(JoinSamples, joins_by_time_sums_numbered_parts_and_leaves_out_what_is_no_muscle) {
  const JoinedSamples joined = join_samples({trial()}, {});
  EXPECT_THAT(joined.samples.columns, ElementsAre("hip_flexion_r", "glut_max_r"));
  EXPECT_THAT(column(joined.samples, 0),
              ElementsAre(testing::DoubleNear(10, 1e-9), testing::DoubleNear(20, 1e-9), testing::DoubleNear(30, 1e-9)));
  EXPECT_THAT(column(joined.samples, 1), ElementsAre(testing::DoubleNear(0.4, 1e-12), testing::DoubleNear(1.4, 1e-12),
                                                     testing::DoubleNear(0.4, 1e-12)));
  EXPECT_THAT(joined.problems, IsEmpty());
  EXPECT_THAT(joined.notes,
              ElementsAre(HasSubstr("FX"),
                          HasSubstr("glut_max_r: the sum of its parts exceeds 1 in 1 of 3 samples, up to 1.400")));
}

TEST(JoinSamples, combines_by_maximum_or_by_a_mean_weighted_with_forces) {
  JoinSettings settings;
  settings.combine = CombineParts::maximum;
  EXPECT_THAT(column(join_samples({trial()}, settings).samples, 1), ElementsAre(0.3, 0.8, 0.2));
  settings.combine = CombineParts::weighted_mean;
  const std::vector<Real> weighted = column(join_samples({trial()}, settings).samples, 1);
  EXPECT_NEAR(weighted[0], (0.1 * 100 + 0.3 * 300) / 400, 1e-12);
  EXPECT_NEAR(weighted[1], 0.7, 1e-12) << "no force at all: the plain mean";
}

TEST(JoinSamples, takes_the_nearest_time_within_the_tolerance_and_lists_what_has_none) {
  Trial late = trial();
  late.activations.times = {0.0004, 0.1, 0.25};
  const JoinedSamples joined = join_samples({late}, {});
  EXPECT_EQ(joined.samples.times.size(), 2u);
  EXPECT_THAT(
      joined.problems,
      ElementsAre(HasSubstr("1 of 3 times of the results have no row of the motion within 0.001 s, first 0.25 s")));
}

TEST(JoinSamples, maps_names_and_lists_missing_columns_and_negative_values) {
  Trial bad = trial();
  bad.activations.values(1, 0) = -0.2;
  JoinSettings settings;
  settings.muscles = {{"gluteus_maximus_r", {"glut_max1_r", "glut_max3_r"}}, {"psoas", {"psoas_r"}}};
  const JoinedSamples joined = join_samples({bad}, settings);
  EXPECT_THAT(joined.samples.columns, ElementsAre("hip_flexion_r", "gluteus_maximus_r"));
  EXPECT_THAT(column(joined.samples, 1), ElementsAre(0.1, 0, 0.2));
  EXPECT_THAT(joined.problems,
              ElementsAre(HasSubstr("psoas: none of its columns"), HasSubstr("no column 'glut_max3_r'"),
                          HasSubstr("'glut_max1_r' is negative in 1 of 3 rows, down to -0.2")));
}

TEST(JoinSamples, puts_trials_one_after_the_other_and_keeps_the_coordinates_that_all_have) {
  Trial second = trial();
  second.motion.columns[0] = "knee_angle_r";
  EXPECT_THROW(join_samples({trial(), second}, {}), InputError) << "nothing in common";
  const JoinedSamples joined = join_samples({trial(), trial()}, {});
  ASSERT_EQ(joined.samples.times.size(), 6u);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_GT(joined.samples.times[i], joined.samples.times[i - 1]);
}

TEST(JoinSamples, knows_muscles_by_their_names) {
  EXPECT_FALSE(is_muscle_column("FX"));
  EXPECT_FALSE(is_muscle_column("hip_flexion_r_reserve"));
  EXPECT_TRUE(is_muscle_column("glut_max1_r"));
  const std::vector<MuscleParts> groups = grouped_parts({"glut_max1_r", "vas_int_r", "glut_max2_r", "glut_max1_l"});
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].muscle, "glut_max_r");
  EXPECT_THAT(groups[0].columns, ElementsAre("glut_max1_r", "glut_max2_r"));
  EXPECT_EQ(groups[2].muscle, "glut_max1_l") << "a single part keeps its number";
}

TEST(MuscleMapping, reads_one_or_several_columns_and_refuses_what_names_none) {
  const TestFolder folder;
  const std::vector<MuscleParts> muscles =
      read_muscle_mapping(folder.write("map.toml", "a = \"x\"\nb = [\"y\", \"z\"]\n"));
  ASSERT_EQ(muscles.size(), 2u);
  EXPECT_THAT(muscles[1].columns, ElementsAre("y", "z"));
  EXPECT_THROW(read_muscle_mapping(folder.write("bad.toml", "a = 3\n")), ConfigurationError);
  EXPECT_THROW(read_muscle_mapping(folder.write("worse.toml", "a = \n")), ConfigurationError);
}

TEST(PairedFiles, go_by_equal_names_and_by_pairs_and_what_is_left_alone_is_listed) {
  const TestFolder folder;
  for (const char* name : {"m/walk.mot", "m/run.mot", "m/other.sto", "r/walk.sto", "r/sprint.sto", "r/alone.sto"}) {
    std::filesystem::create_directories((folder.path() / name).parent_path());
    folder.write(name, "x");
  }
  std::vector<std::string> problems;
  const auto files = paired_files(folder.path() / "m", folder.path() / "r", {{"run.mot", "sprint.sto"}}, problems);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].second.filename(), "sprint.sto");
  EXPECT_EQ(files[1].first.filename(), "walk.mot");
  EXPECT_THAT(problems, ElementsAre(HasSubstr("other.sto"), HasSubstr("alone.sto")));
  EXPECT_THROW(paired_files(folder.path() / "none", folder.path() / "r", {}, problems), InputError);
}

}  // namespace gracilis
