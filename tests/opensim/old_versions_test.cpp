#include "opensim/model_texts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis::opensim {

using testing::HasSubstr;

/// The pendulum as a document of another version.
static std::string pendulum_of(const std::string& version, const std::string& forces) {
  return document(set("BodySet", body("rod")) +
                      set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", coordinate("swing"))) +
                      set("ForceSet", forces),
                  version);
}

static const std::string old_way = point("/ground", "1 0 0") + point("/bodyset/rod", "0 -1 0");

TEST(OldVersions, a_natural_cubic_spline_is_the_old_name_of_a_simm_spline_in_every_version) {
  const std::string axis =
      "<SpatialTransform><TransformAxis name=\"rotation1\"><coordinates>swing</coordinates><axis>0 0 1</axis>"
      "<NaturalCubicSpline><x>0 1 2 3</x><y>0 1 8 27</y></NaturalCubicSpline></TransformAxis></SpatialTransform>";
  for (const char* version : {"20303", "30000", "40000"}) {
    const Model model =
        model_from(document(set("BodySet", body("rod")) + set("JointSet", joint("CustomJoint", "hinge", "/ground",
                                                                                "rod", coordinate("swing"), axis)),
                            version));
    // Through points of a cube it is that cube; a spline without curvature at its ends is not.
    EXPECT_NEAR(value(model.joints[0].axes[0].function, {0.5}), 0.125, 1e-12) << version;
  }
}

TEST(OldVersions, pennation_angle_had_another_name_up_to_20301) {
  const std::string forces = muscle("m", old_way, "<pennation_angle>0.3</pennation_angle>");
  EXPECT_EQ(model_from(pendulum_of("20301", forces)).muscles.at(0).pennation_angle_at_optimal, 0.3);
  EXPECT_EQ(model_from(pendulum_of("20302", forces)).muscles.at(0).pennation_angle_at_optimal, 0);
}

TEST(OldVersions, a_least_control_of_zero_meant_nothing_before_30513) {
  const auto least = [](const std::string& version, const std::string& given) {
    return model_from(pendulum_of(version, muscle("m", old_way, "<min_control>" + given + "</min_control>")))
        .muscles.at(0)
        .min_control;
  };
  EXPECT_EQ(least("30512", "0"), Muscle().min_control);
  EXPECT_GT(Muscle().min_control, 0);
  EXPECT_EQ(least("30512", "0.2"), 0.2);
  EXPECT_EQ(least("30513", "0"), 0);
}

/// A custom joint whose axes stand in one set, a translation before a rotation.
static std::string old_axes(const std::string& version) {
  return document(
      set("BodySet", body("rod")) +
          set("JointSet",
              joint("CustomJoint", "knee", "/ground", "rod", coordinate("slide") + coordinate("bend"),
                    set("TransformAxisSet",
                        "<TransformAxis name=\"ty\"><is_rotation>false</is_rotation><coordinate>slide</coordinate>"
                        "<axis>0 1 0</axis><function><LinearFunction><coefficients>2 0</coefficients></LinearFunction>"
                        "</function></TransformAxis><TransformAxis name=\"rz\"><is_rotation> True </is_rotation>"
                        "<coordinate>bend</coordinate><axis>0 0 1</axis></TransformAxis>"))),
      version);
}

TEST(OldVersions, a_set_of_axes_is_a_spatial_transform_before_10901) {
  const Model model = model_from(old_axes("10900"));
  ASSERT_EQ(model.joints.size(), 1u);
  const Joint& knee = model.joints[0];
  EXPECT_THAT(knee.axes[0].coordinates, testing::ElementsAre(1));
  EXPECT_EQ(knee.axes[0].axis, Vec3::UnitZ());
  EXPECT_THAT(knee.axes[3].coordinates, testing::ElementsAre(0));
  EXPECT_EQ(knee.axes[3].axis, Vec3::UnitY());
  EXPECT_EQ(value(knee.axes[3].function, {0.5}), 1);
  EXPECT_FALSE(model.coordinates[0].rotation);
  EXPECT_TRUE(model.coordinates[1].rotation);
}

TEST(OldVersions, a_custom_joint_without_axes_is_told) {
  const std::string told = "CustomJoint 'knee': has no <SpatialTransform>";
  EXPECT_THAT(model_from(old_axes("10901")).unsupported, testing::Contains(HasSubstr(told)));
  EXPECT_THAT(model_from(old_axes("10900")).unsupported, testing::Not(testing::Contains(HasSubstr(told))));
}

TEST(OldVersions, a_moving_point_had_attachments_before_version_3) {
  const std::string moving =
      "<MovingMusclePoint name=\"p\"><body>rod</body><x_coordinate>swing</x_coordinate><XAttachment><natCubicSpline>"
      "<x>0 1 2 3</x><y>0 1 8 "
      "27</y></natCubicSpline></XAttachment><YAttachment><Constant><value>-0.4</value></Constant>"
      "</YAttachment></MovingMusclePoint>";
  const Model model = model_from(pendulum_of("20303", muscle("m", point("/ground", "1 0 0") + moving)));
  const PathPoint& read = model.muscles.at(0).path.points.at(1);
  EXPECT_EQ(read.moves_with[0], 0);
  EXPECT_NEAR(value(read.moves_to[0], {0.5}), 0.125, 1e-12);
  EXPECT_EQ(value(read.moves_to[1], {0}), -0.4);
}

TEST(OldVersions, actuators_are_known_by_their_old_names) {
  const Model model = model_from(pendulum(
      "<GeneralizedForce name=\"g\"><coordinate>swing</coordinate><optimal_force>3</optimal_force></GeneralizedForce>"
      "<Force name=\"f\"><body>rod</body><point>0 1 0</point><direction>0 0 2</direction></Force>"
      "<Torque name=\"t\"><bodyA>rod</bodyA><bodyB>ground</bodyB><axis>0 1 0</axis></Torque>"));
  EXPECT_THAT(model.unsupported, testing::IsEmpty());
  ASSERT_EQ(model.actuators.size(), 3u);
  EXPECT_EQ(model.actuators[0].kind, Actuator::Kind::coordinate);
  EXPECT_EQ(model.actuators[0].optimal_force, 3);
  EXPECT_EQ(model.actuators[1].kind, Actuator::Kind::point);
  EXPECT_EQ(model.actuators[1].direction, Vec3::UnitZ());
  EXPECT_EQ(model.actuators[2].kind, Actuator::Kind::torque);
  EXPECT_EQ(model.actuators[2].body, 1);
}

}  // namespace gracilis::opensim
