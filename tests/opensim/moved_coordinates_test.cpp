#include "opensim/model_texts.hpp"

#include <gracilis/opensim/export/scene_lengths.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis::opensim {

/// Poses are spread over what muscles cross: a whole body's motion moves more coordinates than any sequence has
/// numbers.
TEST(MovedCoordinates, are_those_that_the_runs_muscles_cross) {
  const Model model = model_from(document(
      set("BodySet", body("upper") + body("lower")) +
      set("JointSet", joint("PinJoint", "top", "/ground", "upper", coordinate("a")) +
                          joint("PinJoint", "middle", "/bodyset/upper", "lower", coordinate("b"), "", "0 -1 0")) +
      set("ForceSet", muscle("m", point("/bodyset/upper", "0.1 -0.8 0") + point("/bodyset/lower", "0.1 -0.2 0")))));
  LengthSamples run;
  run.coordinates = Eigen::MatrixXd::Zero(3, 2);
  run.coordinates.row(2) = Eigen::RowVector2d(0.4, 0.5);
  run.muscles = {{"m", Eigen::VectorXd::Ones(3), Eigen::MatrixXd(3, 0)}};
  Scene scene;
  scene.joints.resize(1);
  scene.joints[0].axes.resize(2);
  scene.joints[0].axes[0].coordinate = "a";
  scene.joints[0].axes[1].coordinate = "b";
  EXPECT_THAT(moved_coordinates(run, model, scene), testing::ElementsAre(1));
  run.muscles[0].name = "stranger";  // may cross any
  EXPECT_THAT(moved_coordinates(run, model, scene), testing::ElementsAre(0, 1));
}

}  // namespace gracilis::opensim
