#include "app/program.hpp"
#include "opensim/model_texts.hpp"

#include <gracilis/io/tables/table.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {

static ProgramResult sampled(const TestFolder& folder, const std::string& options) {
  const auto model = folder.write("tiny.osim", opensim::pendulum());
  return run_program("motions " + model.string() + " --out " + (folder.path() / "motions").string() + " " + options);
}

TEST(MotionsCommand, an_angle_goes_through_its_range_at_its_speed_and_time_step) {
  const TestFolder folder;
  const ProgramResult result = sampled(folder, "--range swing=-10:40 --steps 1 --speed 60 --time-step 0.02");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Table table = read_table(folder.path() / "motions/hinge_swing.mot");
  const auto column = column_of(table, "swing");
  ASSERT_TRUE(column.has_value());
  const Eigen::VectorXd angle = table.values.col(*column) * (table.in_degrees ? 1 : degrees(1));
  EXPECT_NEAR(angle[0], -10, 1e-9);
  EXPECT_NEAR(angle[angle.size() - 1], 40, 1e-9);
  EXPECT_NEAR(table.times[1] - table.times[0], 0.02, 1e-9);
  Real fastest = 0;
  for (Eigen::Index i = 1; i < angle.size(); ++i) fastest = std::max(fastest, (angle[i] - angle[i - 1]) / 0.02);
  EXPECT_LE(fastest, 60 + 1e-6);
  EXPECT_GT(fastest, 55);
}

TEST(MotionsCommand, wrong_ranges_are_named) {
  const TestFolder folder;
  EXPECT_THAT(sampled(folder, "--range swim=-10:40").err, testing::HasSubstr("did you mean 'swing'?"));
  EXPECT_EQ(sampled(folder, "--range swing=-10").exit_code, 2);
  EXPECT_EQ(sampled(folder, "--combined spiral").exit_code, 2);
  EXPECT_THAT(sampled(folder, "--speed 0.001 --time-step 0.00001").err, testing::HasSubstr("more than a million rows"));
}

}  // namespace gracilis
