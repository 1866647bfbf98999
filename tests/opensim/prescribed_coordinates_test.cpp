#include "opensim/model_texts.hpp"

#include <gracilis/opensim/static_optimization/static_optimization.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis::opensim {

/// A pendulum whose coordinate says more, and an actuator that could hold it.
static Model prescribed_pendulum(const std::string& more) {
  const std::string swing = "<Coordinate name=\"swing\"><default_value>0.1</default_value>" + more + "</Coordinate>";
  return model_from(document(set("BodySet", body("rod")) +
                             set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", swing)) +
                             set("ForceSet",
                                 "<CoordinateActuator name=\"motor\"><coordinate>swing</coordinate>"
                                 "<optimal_force>1</optimal_force></CoordinateActuator>")));
}

static const std::string by_function = "<prescribed>true</prescribed><prescribed_function>";

TEST(PrescribedCoordinates, one_at_a_constant_is_locked_there) {
  const Model model =
      prescribed_pendulum(by_function + "<Constant><value>0.7</value></Constant></prescribed_function>");
  EXPECT_EQ(default_coordinates(model)[0], 0.7);
  EXPECT_TRUE(model.coordinates[0].locked);
  EXPECT_THAT(model.unsupported, testing::IsEmpty());
}

TEST(PrescribedCoordinates, one_that_follows_time_starts_at_its_first_value_which_is_told) {
  const Model model = prescribed_pendulum(by_function +
                                          "<LinearFunction><coefficients>2 0.3</coefficients>"
                                          "</LinearFunction></prescribed_function>");
  EXPECT_EQ(default_coordinates(model)[0], 0.3);
  EXPECT_TRUE(model.coordinates[0].locked);
  EXPECT_THAT(model.unsupported, testing::ElementsAre(testing::HasSubstr("'swing': follows a function of time")));
}

TEST(PrescribedCoordinates, without_a_function_or_where_it_is_not_asked_for_nothing_changes) {
  const std::string constant = "<prescribed_function><Constant><value>0.7</value></Constant></prescribed_function>";
  for (const std::string& more : {std::string("<prescribed>true</prescribed>"),
                                  std::string("<prescribed>true</prescribed><prescribed_function/>"), constant,
                                  "<prescribed>false</prescribed>" + constant}) {
    const Model model = prescribed_pendulum(more);
    EXPECT_EQ(default_coordinates(model)[0], 0.1) << more;
    EXPECT_FALSE(model.coordinates[0].locked) << more;
    EXPECT_THAT(model.unsupported, testing::IsEmpty()) << more;
  }
}

TEST(PrescribedCoordinates, a_lock_goes_before_the_function) {
  const Model model = prescribed_pendulum("<locked>true</locked>" + by_function +
                                          "<Constant><value>0.7</value></Constant></prescribed_function>");
  EXPECT_EQ(default_coordinates(model)[0], 0.1);
}

TEST(PrescribedCoordinates, one_of_a_function_that_is_not_known_stays_at_its_default_value) {
  const Model model = prescribed_pendulum(by_function + "<SignalGeneratorFunction/></prescribed_function>");
  EXPECT_EQ(default_coordinates(model)[0], 0.1);
  EXPECT_TRUE(model.coordinates[0].locked);
  EXPECT_THAT(model.unsupported, testing::ElementsAre(testing::HasSubstr("SignalGeneratorFunction")));
}

TEST(PrescribedCoordinates, ask_nothing_of_static_optimization) {
  const Model model =
      prescribed_pendulum(by_function + "<Constant><value>0.7</value></Constant></prescribed_function>");
  CoordinateMotion motion;
  for (int i = 0; i < 8; ++i) motion.times.push_back(0.1 * i);
  motion.values = Eigen::MatrixXd::Constant(8, 1, 0.7);
  EXPECT_NEAR(static_optimization(model, motion, {}, {3}, {}).activations.values(0, 0), 0, 1e-6);
}

}  // namespace gracilis::opensim
