#include "opensim/model_texts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

/// A property that is one function stands below an element of its name, or is named so itself.
namespace gracilis::opensim {

TEST(FunctionProperties, a_ligament_s_curve_may_be_named_after_the_property) {
  const std::string begin = "<Ligament name=\"l\"><GeometryPath>" +
                            set("PathPointSet", point("/ground", "0.3 0 0") + point("/bodyset/rod", "0 -0.4 0")) +
                            "</GeometryPath><resting_length>0.5</resting_length><pcsa_force>300</pcsa_force>";
  const std::string knots = "<x>0 1 2</x><y>0 0 4</y></PiecewiseLinearFunction>";
  for (const std::string& curve :
       {"<force_length_curve><PiecewiseLinearFunction>" + knots + "</force_length_curve>",
        "<PiecewiseLinearFunction name=\"force_length_curve\">" + knots, "<PiecewiseLinearFunction>" + knots}) {
    const Model model = model_from(pendulum(begin + curve + "</Ligament>"));
    ASSERT_EQ(model.passive_forces.size(), 1u);
    EXPECT_EQ(value(model.passive_forces[0].curve, {1.5}), 2) << curve;
  }
}

TEST(FunctionProperties, a_moving_point_s_places_may_be_named_after_their_properties) {
  std::string moving = "<MovingPathPoint name=\"p\"><socket_parent_frame>/bodyset/rod</socket_parent_frame>";
  for (const std::string axis : {"x", "y", "z"})
    moving += "<socket_" + axis + "_coordinate>/jointset/hinge/swing</socket_" + axis + "_coordinate>";
  moving +=
      "<Constant name=\"z_location\"><value>0.2</value></Constant><LinearFunction name=\"x_location\"><coefficients>3 1"
      "</coefficients></LinearFunction><LinearFunction name=\"y_location\"><coefficients>5 2</coefficients>"
      "</LinearFunction></MovingPathPoint>";
  const Model model = model_from(pendulum(muscle("m", point("/ground", "1 0 0") + moving)));
  const PathPoint& read = model.muscles.at(0).path.points.at(1);
  EXPECT_EQ(value(read.moves_to[0], {0.5}), 2.5);
  EXPECT_EQ(value(read.moves_to[1], {0.5}), 4.5);
  EXPECT_EQ(value(read.moves_to[2], {0}), 0.2);
}

TEST(FunctionProperties, a_path_s_length_may_be_named_after_the_property) {
  const Model model = model_from(pendulum(
      "<Millard2012EquilibriumMuscle name=\"m\"><FunctionBasedPath "
      "name=\"path\"><coordinate_paths>/jointset/hinge/swing"
      "</coordinate_paths><MultivariatePolynomialFunction name=\"length_function\"><dimension>1</dimension><order>1"
      "</order><coefficients>0.5 -0.1</coefficients></MultivariatePolynomialFunction></FunctionBasedPath>"
      "</Millard2012EquilibriumMuscle>"));
  ASSERT_EQ(model.muscles.size(), 1u);
  EXPECT_NEAR(value(model.muscles[0].path.length_function, {2}), 0.3, 1e-15);
}

TEST(FunctionProperties, a_coupler_s_function_may_be_named_after_the_property) {
  for (const std::string name : {" name=\"coupled_coordinates_function\"", ""}) {
    const Model model = model_from(document(
        set("BodySet", body("rod") + body("tip")) +
        set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", coordinate("swing")) +
                            joint("PinJoint", "knee", "/bodyset/rod", "tip", coordinate("bend"))) +
        set("ConstraintSet", "<CoordinateCouplerConstraint name=\"c\"><LinearFunction" + name +
                                 "><coefficients>2 0.1</coefficients></LinearFunction><independent_coordinate_names>"
                                 "swing</independent_coordinate_names><dependent_coordinate_name>bend"
                                 "</dependent_coordinate_name></CoordinateCouplerConstraint>")));
    ASSERT_EQ(model.couplers.size(), 1u);
    EXPECT_NEAR(value(model.couplers[0].function, {1}), 2.1, 1e-15);
  }
}

}  // namespace gracilis::opensim
