#include "opensim/model_texts.hpp"

#include <gracilis/opensim/export/arm_courses.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

TEST(ArmCourses, are_of_both_models_through_the_runs_range) {
  const std::string ways = muscle("far", point("/ground", "0.3 0 0") + point("/bodyset/rod", "0 -0.4 0")) +
                           muscle("near", point("/ground", "0.2 0 0") + point("/bodyset/rod", "0 -0.3 0"));
  const Model before = model_from(pendulum(ways));
  Model after = before;  // the first muscle's length a line of the coordinate: an arm of 50 mm everywhere
  after.muscles[0].path = {};
  after.muscles[0].path.function_coordinates = {0};
  after.muscles[0].path.length_function = linear(-0.05, 0.6);
  const std::vector<ArmCourse> courses = arm_courses(before, after, Eigen::Vector3d(-0.2, 0.1, 0.5), 10);
  ASSERT_EQ(courses.size(), 2u);
  EXPECT_EQ(courses[0].muscle, "far");  // the larger difference first
  EXPECT_EQ(courses[1].largest, 0);
  ASSERT_EQ(courses[0].at.size(), 11u);
  EXPECT_NEAR(courses[0].at.front(), -0.2, 1e-12);
  EXPECT_NEAR(courses[0].at.back(), 0.5, 1e-12);
  Real largest = 0;
  for (std::size_t i = 0; i < courses[0].at.size(); ++i) {
    const Real q = courses[0].at[i], length = std::sqrt(0.25 - 0.24 * std::sin(q));
    EXPECT_NEAR(courses[0].before[i], 0.12 * std::cos(q) / length, 1e-9);
    EXPECT_NEAR(courses[0].after[i], 0.05, 1e-12);
    largest = std::max(largest, std::abs(courses[0].before[i] - 0.05));
  }
  EXPECT_NEAR(courses[0].largest, largest, 1e-12);
}

TEST(ArmCourses, are_not_of_coordinates_that_rest) {
  const Model model =
      model_from(pendulum(muscle("m", point("/ground", "0.3 0 0") + point("/bodyset/rod", "0 -0.4 0"))));
  EXPECT_TRUE(arm_courses(model, model, Eigen::Vector3d(0.2, 0.2, 0.21)).empty());
}

}  // namespace gracilis::opensim
