#include <gracilis/core/errors.hpp>
#include <gracilis/scene/motion.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace gracilis {

using testing::ElementsAre;

TEST(Motion, key_poses_are_met_exactly_with_equal_steps_between_them) {
  Eigen::MatrixXd keys(3, 2);
  keys << 0, 0, 1, 0.5, 1, 0.75;
  const Motion motion = motion_through({"a", "b"}, keys, 0.25, 0.1);
  ASSERT_EQ(motion.times.size(), 1u + 4u + 1u);
  EXPECT_EQ(motion.values.row(0), keys.row(0));
  EXPECT_EQ(motion.values.row(4), keys.row(1));
  EXPECT_EQ(motion.values.row(5), keys.row(2));
  EXPECT_NEAR(motion.values(1, 1), 0.125, 1e-15);
  EXPECT_NEAR(motion.times[5], 0.5, 1e-15);
}

TEST(Motion, a_single_key_pose_is_a_single_row_and_none_is_none) {
  EXPECT_EQ(motion_through({"a"}, Eigen::MatrixXd::Constant(1, 1, 2), 0.1, 1).times.size(), 1u);
  EXPECT_EQ(motion_through({"a"}, Eigen::MatrixXd(0, 1), 0.1, 1).times.size(), 0u);
}

TEST(Motion, key_poses_that_repeat_are_rows_that_repeat) {
  EXPECT_EQ(motion_through({"a"}, Eigen::MatrixXd::Constant(3, 1, 2), 0.1, 1).times.size(), 3u);
}

TEST(Motion, unknown_coordinates_are_dropped_and_named) {
  Motion motion{"m", {"x", "a", "y", "b"}, {0}, Eigen::RowVector4d(1, 2, 3, 4)};
  EXPECT_THAT(drop_unknown_coordinates(motion, {"b", "a"}), ElementsAre("x", "y"));
  EXPECT_THAT(motion.coordinates, ElementsAre("a", "b"));
  EXPECT_EQ(motion.values, Eigen::RowVector2d(2, 4));
}

TEST(Motion, steps_are_counted_where_an_int_would_wrap_around) {
  EXPECT_EQ(steps_over(1e6, 1e-6), 1'000'000'000'000);
  EXPECT_EQ(steps_over(0, 1), 1);
  EXPECT_EQ(steps_over(-3, 1), 3);
  EXPECT_EQ(steps_over(7 * 0.1, 0.1), 7);
  EXPECT_EQ(steps_over(1e308, 1e-3), std::int64_t{1} << 62);
  EXPECT_EQ(steps_over(std::numeric_limits<Real>::infinity(), 1), std::int64_t{1} << 62);
}

TEST(Motion, more_frames_than_allowed_are_refused_before_any_is_made) {
  const Eigen::MatrixXd keys = Eigen::Vector2d(0, 1e6);
  try {
    motion_through({"a"}, keys, 1e-6, 1);
    FAIL() << "1e12 rows were made";
  } catch (const ConfigurationError& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_THAT(error.what(), testing::HasSubstr("more than 1000000 frames"));
  }
  EXPECT_THROW(motion_through({"a"}, Eigen::Vector2d(-1e308, 1e308), 1, 1), ConfigurationError);
  EXPECT_THROW(motion_through({"a"}, Eigen::Vector3d(0, 6, 0), 1, 1, 10), ConfigurationError);
  EXPECT_EQ(motion_through({"a"}, Eigen::Vector3d(0, 5, 0), 1, 1, 10 + 1).times.size(), 11u);
}

TEST(Motion, over_a_grid_has_every_combination_once_and_neighbors_differ_by_one_step) {
  const std::vector<Eigen::VectorXd> values = {Eigen::Vector3d(0, 1, 2), Eigen::VectorXd::Constant(1, 7),
                                               Eigen::Vector2d(10, 20), Eigen::Vector2d(5, 6)};
  const Motion motion = motion_over_grid({"a", "fixed", "b", "c"}, values, 0.5);
  ASSERT_EQ(motion.values.rows(), 12);
  EXPECT_EQ(motion.times[11], 5.5);
  EXPECT_THAT(motion.values.col(0), ElementsAre(0, 1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0));
  EXPECT_THAT(motion.values.col(2), ElementsAre(10, 10, 10, 20, 20, 20, 20, 20, 20, 10, 10, 10));
  EXPECT_THAT(motion.values.col(3), ElementsAre(5, 5, 5, 5, 5, 5, 6, 6, 6, 6, 6, 6));
  EXPECT_TRUE((motion.values.col(1).array() == 7).all());
  EXPECT_EQ(motion_over_grid({"a"}, {Eigen::VectorXd::Constant(1, 3)}, 1).times.size(), 1u);
}

TEST(Motion, over_a_grid_of_too_many_frames_is_refused_before_it_is_made) {
  const std::vector<Eigen::VectorXd> values(7, Eigen::VectorXd::Zero(1000));
  EXPECT_THROW(motion_over_grid({"a", "b", "c", "d", "e", "f", "g"}, values, 1), ConfigurationError);
  EXPECT_EQ(motion_over_grid({"a", "b"}, {values[0], values[0]}, 1).times.size(), 1'000'000u);
  EXPECT_THROW(motion_over_grid({"a", "b"}, {values[0], values[0]}, 1, 999'999), ConfigurationError);
}

TEST(Motion, values_through_a_range_are_those_of_a_motion_through_it) {
  for (const auto& [from, to, step] : {std::array{0.0, 1.0, 0.3}, {2.0, -1.0, 0.7}, {0.1, 0.2, 5.0}}) {
    const Motion motion = motion_through({"a"}, Eigen::Vector2d(from, to), step, 1);
    EXPECT_EQ(values_through(from, to, step), motion.values.col(0)) << from;
  }
  EXPECT_EQ(values_through(3, 3, 1).size(), 2);
  EXPECT_THROW(values_through(0, 1e308, 1e-3), ConfigurationError);
}

}  // namespace gracilis
