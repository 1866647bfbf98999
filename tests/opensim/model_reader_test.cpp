#include "opensim/model_texts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gracilis::opensim {

using testing::HasSubstr;

TEST(ModelReader, reads_bodies_joints_and_coordinates) {
  const Model model = model_from(pendulum());
  EXPECT_EQ(model.name, "tiny");
  ASSERT_EQ(model.bodies.size(), 2u);
  EXPECT_EQ(model.bodies[0].name, "ground");
  EXPECT_EQ(model.bodies[1].mass, 2);
  EXPECT_EQ(model.bodies[1].mass_center, Vec3(0, -0.5, 0));
  ASSERT_EQ(model.joints.size(), 1u);
  EXPECT_EQ(model.joints[0].child_body, 1);
  ASSERT_EQ(model.coordinates.size(), 1u);
  EXPECT_TRUE(model.coordinates[0].rotation);
  EXPECT_TRUE(model.unsupported.empty());
}

TEST(ModelReader, takes_frames_of_old_joints_with_six_digits_as_opensim_4_does) {
  const Model model = model_from(
      document("<BodySet><objects><Body name=\"rod\"><mass>2</mass><inertia_xx>1</inertia_xx><Joint><PinJoint name="
               "\"hinge\"><parent_body>ground</parent_body><location_in_parent>-0.39082568 0.0700429068 12.5"
               "</location_in_parent><orientation_in_parent>0 0 1.57079633</orientation_in_parent></PinJoint></Joint>"
               "</Body></objects></BodySet>",
               "30000"));
  EXPECT_EQ(model.joints[0].parent_frame.translation(), Vec3(-0.390826, 0.0700429, 12.5));
  EXPECT_NEAR(model.joints[0].parent_frame.linear()(0, 0), std::cos(1.5708), 1e-15);
}

TEST(ModelReader, numbers_next_to_zero_are_read_as_such) {
  const Model model = model_from(
      document("<BodySet><objects><Body name=\"rod\"><mass>2</mass><inertia_xx>1</inertia_xx><Joint><PinJoint name="
               "\"hinge\"><parent_body>ground</parent_body><location_in_parent>1e-310 -4e-320 2</location_in_parent>"
               "</PinJoint></Joint></Body></objects></BodySet>",
               "30000"));
  EXPECT_TRUE(model.joints[0].parent_frame.translation().isApprox(Vec3(0, 0, 2)));
}

TEST(ModelReader, reads_joints_inside_bodies_as_version_3_has_them) {
  const Model model = model_from(document(
      "<BodySet><objects><Body name=\"ground\"><mass>0</mass></Body><Body name=\"rod\"><mass>2</mass><inertia_xx>1"
      "</inertia_xx><Joint><CustomJoint name=\"hinge\"><parent_body>ground</parent_body><location_in_parent>1 2 3"
      "</location_in_parent><CoordinateSet><objects><Coordinate name=\"slide\"><motion_type>translational</motion_type>"
      "</Coordinate></objects></CoordinateSet><SpatialTransform><TransformAxis name=\"translation2\"><coordinates>slide"
      "</coordinates><axis>0 2 0</axis><function><MultiplierFunction><function><LinearFunction><coefficients> 1 0"
      "</coefficients></LinearFunction></function><scale>3</scale></MultiplierFunction></function></TransformAxis>"
      "</SpatialTransform></CustomJoint></Joint><VisibleObject><GeometrySet><objects><DisplayGeometry><geometry_file>"
      ".\\geometry\\rod.vtp</geometry_file><scale_factors>1 2 3</scale_factors></DisplayGeometry></objects>"
      "</GeometrySet><scale_factors>0.001 0.001 0.001</scale_factors></VisibleObject></Body></objects></BodySet>",
      "30000"));
  ASSERT_EQ(model.joints.size(), 1u);
  EXPECT_EQ(model.joints[0].parent_frame.translation(), Vec3(1, 2, 3));
  EXPECT_FALSE(model.coordinates[0].rotation);
  const TransformAxis& axis = model.joints[0].axes[4];
  EXPECT_EQ(axis.axis, Vec3::UnitY());
  EXPECT_EQ(value(axis.function, {0.5}), 1.5);
  ASSERT_EQ(model.bodies[1].geometry.size(), 1u);
  EXPECT_EQ(model.bodies[1].geometry[0].file, "geometry/rod.vtp");
  EXPECT_TRUE(model.bodies[1].geometry[0].scale.isApprox(Vec3(0.001, 0.002, 0.003)));
}

TEST(ModelReader, survives_bytes_that_are_not_utf_8) {
  const Model model = model_from(document("<credits>Universit\xe9</credits>" + set("BodySet", body("rod")) +
                                          set("JointSet", joint("WeldJoint", "fixed", "/ground", "rod", ""))));
  EXPECT_EQ(model.bodies.size(), 2u);
}

TEST(ModelReader, entities_of_a_document_type_stay_unread) {
  const std::string text = pendulum();
  const std::string evil = "<!DOCTYPE x [<!ENTITY a \"aaaa\"><!ENTITY b SYSTEM \"file:///etc/passwd\">]>";
  const Model model = model_from(evil + text.substr(text.find("?>") + 2));
  EXPECT_EQ(model.bodies.size(), 2u);
}

TEST(ModelReader, a_model_without_a_name_is_called_as_its_file) {
  const TestFolder folder;
  const auto name_of_model = [&](const std::string& attribute) {
    const std::string text = "<OpenSimDocument Version='40000'><Model" + attribute + "/></OpenSimDocument>";
    return read_model(folder.write("leg.osim", text)).name;
  };
  EXPECT_EQ(name_of_model(""), "leg");
  EXPECT_EQ(name_of_model(" name='arm'"), "arm");
}

TEST(ModelReader, lists_what_it_leaves_out) {
  const Model model = model_from(document(
      set("BodySet", body("rod", "<attached_geometry><Brick name=\"box\"/></attached_geometry>")) +
      set("JointSet", joint("ConveyorJoint", "gliding", "/ground", "rod", coordinate("swing"))) +
      set("ForceSet", "<BushingForce name=\"bush\"/>") + set("ConstraintSet", "<PointConstraint name=\"loop\"/>")));
  EXPECT_THAT(model.unsupported, testing::UnorderedElementsAre(HasSubstr("Brick 'box'"), HasSubstr("'gliding'"),
                                                               HasSubstr("'bush'"), HasSubstr("'loop'")));
}

TEST(ModelReader, a_force_set_is_appended_or_takes_the_place_of_the_models_forces) {
  const std::string forces =
      "<OpenSimDocument Version=\"40000\"><ForceSet><objects><CoordinateActuator name=\"reserve\"><coordinate>swing"
      "</coordinate><optimal_force>5</optimal_force></CoordinateActuator></objects></ForceSet></OpenSimDocument>";
  const TestFolder folder;
  const auto path = folder.write("forces.xml", forces);
  const auto model_path =
      folder.write("m.osim", pendulum(muscle("m", point("/ground", "0 0 0") + point("rod", "0 -1 0"))));
  Model model = read_model(model_path);
  read_force_set(path, false, model);
  EXPECT_EQ(model.muscles.size(), 1u);
  ASSERT_EQ(model.actuators.size(), 1u);
  EXPECT_EQ(model.actuators[0].optimal_force, 5);
  Model other = read_model(model_path);
  read_force_set(path, true, other);
  EXPECT_TRUE(other.muscles.empty());
  EXPECT_EQ(other.actuators.size(), 1u);
}

TEST(ModelReader, names_bodies_that_do_not_exist) {
  EXPECT_THAT(complaint_about(document(set("BodySet", body("rod")) +
                                       set("JointSet", joint("PinJoint", "hinge", "/bodyset/rud", "rod", "")))),
              testing::AllOf(HasSubstr("'/bodyset/rud', which does not exist"), HasSubstr("did you mean 'rod'?")));
}

TEST(ModelReader, refuses_joints_in_a_circle) {
  const std::string text = document(
      set("BodySet", body("a") + body("b")) +
      set("JointSet", joint("PinJoint", "ab", "/bodyset/a", "b", "") + joint("PinJoint", "ba", "/bodyset/b", "a", "")));
  EXPECT_THAT(complaint_about(text), HasSubstr("part of a circle that never meets the ground"));
}

TEST(ModelReader, refuses_a_joint_that_moves_the_ground) {
  const std::string text =
      document(set("BodySet", body("rod")) + set("JointSet",
                                                 "<WeldJoint name=\"w\"><socket_parent_frame>/bodyset/rod"
                                                 "</socket_parent_frame><socket_child_frame>/ground"
                                                 "</socket_child_frame></WeldJoint>"));
  EXPECT_THAT(complaint_about(text), HasSubstr("joint 'w' moves the ground"));
}

TEST(ModelReader, refuses_axes_that_follow_another_joints_coordinate) {
  const std::string text = document(
      set("BodySet", body("rod") + body("tip")) +
      set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", coordinate("swing")) +
                          joint("CustomJoint", "bend", "/bodyset/rod", "tip", "",
                                "<SpatialTransform><TransformAxis name=\"rotation1\"><coordinates>swing</coordinates>"
                                "<axis>0 0 1</axis></TransformAxis></SpatialTransform>")));
  EXPECT_THAT(complaint_about(text), HasSubstr("uses the coordinate 'swing' of another joint"));
}

/// A custom joint about the given axis.
static std::string custom(const std::string& axes) {
  return document(set("BodySet", body("rod")) +
                  set("JointSet", joint("CustomJoint", "hinge", "/ground", "rod", coordinate("swing"),
                                        "<SpatialTransform>" + axes + "</SpatialTransform>")));
}

static std::string axis(const std::string& name, const std::string& direction, const std::string& function = "") {
  return "<TransformAxis name=\"" + name + "\"><coordinates>swing</coordinates><axis>" + direction + "</axis>" +
         function + "</TransformAxis>";
}

TEST(ModelReader, refuses_axes_without_length_and_the_same_axis_twice) {
  EXPECT_THAT(complaint_about(custom(axis("rotation1", "0 0 0"))), HasSubstr("'hinge': has an axis without length"));
  EXPECT_THAT(complaint_about(custom(axis("rotation1", "1 0 0") + axis("rotation2", "-2 0 0"))),
              HasSubstr("has the same axis twice"));
}

TEST(ModelReader, refuses_functions_that_do_not_fit) {
  const auto with = [](const std::string& function) { return custom(axis("rotation1", "1 0 0", function)); };
  EXPECT_THAT(complaint_about(with("<SimmSpline><x>0 1 1</x><y>0 0 0</y></SimmSpline>")),
              HasSubstr("does not increase"));
  EXPECT_THAT(complaint_about(with("<SimmSpline><x>0 1</x><y>0</y></SimmSpline>")),
              HasSubstr("2 values x and 1 values y"));
  EXPECT_THAT(complaint_about(with("<LinearFunction><coefficients>1</coefficients></LinearFunction>")),
              HasSubstr("has 1 coefficients where 2 are needed"));
  EXPECT_THAT(complaint_about(with("<MultivariatePolynomialFunction><dimension>1</dimension><order>1000000000</order>"
                                   "</MultivariatePolynomialFunction>")),
              HasSubstr("order 12 can be read"));
  EXPECT_THAT(complaint_about(with("<GCVSpline><x>0 1 2 3</x><y>0 0 0 0</y><half_order>1e9</half_order></GCVSpline>")),
              HasSubstr("half order from 1 to 4"));
  EXPECT_THAT(complaint_about(with("<GCVSpline><x>0 1 2</x><y>0 0 0</y><half_order>2</half_order></GCVSpline>")),
              HasSubstr("3 points"));
  EXPECT_THAT(complaint_about(with("<GCVSpline><x>0 1 2 3</x><y>0 0 0 0</y><half_order>2</half_order>"
                                   "<weights>1 1 0 1</weights></GCVSpline>")),
              HasSubstr("weights must be above zero"));
  std::string deep = "<Constant><value>1</value></Constant>";
  for (int i = 0; i < 200; ++i) deep = "<MultiplierFunction><function>" + deep + "</function></MultiplierFunction>";
  EXPECT_THAT(complaint_about(with(deep)), HasSubstr("nested more than 100 times"));
}

TEST(ModelReader, elements_nested_a_hundred_thousand_times_do_no_harm) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  for (int i = 0; i < 100000; ++i) deep += "</a>";
  const std::string text =
      document(deep + set("BodySet", body("rod")) + set("JointSet", joint("WeldJoint", "fixed", "/ground", "rod", "")));
  EXPECT_EQ(model_from(text).bodies.size(), 2u);
}

TEST(ModelReader, refuses_what_is_no_model) {
  EXPECT_THAT(complaint_about("<OpenSimDocument Version=\"40000\"><Model>"), HasSubstr("is not XML"));
  EXPECT_THAT(complaint_about("<html/>"), HasSubstr("is no OpenSim document"));
  EXPECT_THAT(complaint_about(document("", "905")), HasSubstr("10000 (OpenSim 1.0) is the oldest"));
}

TEST(ModelReader, refuses_numbers_of_joints_that_nothing_can_be_made_of) {
  EXPECT_THAT(complaint_about(
                  document(set("BodySet", body("rod")) +
                           set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", coordinate("swing", "-Inf"))))),
              HasSubstr("<default_value> holds '-Inf', which is not finite"));
}

TEST(ModelReader, a_control_may_have_no_end) {
  const std::string way = point("/ground", "1 0 0") + point("rod", "0 -1 0");
  EXPECT_EQ(model_from(pendulum(muscle("m", way, "<max_control>Inf</max_control>"))).muscles[0].max_control,
            std::numeric_limits<Real>::infinity());
}

TEST(ModelReader, bytes_that_are_no_utf_8_become_characters_that_can_be_written_again) {
  const Model model = model_from(pendulum(muscle("\xe9\xff", point("/ground", "1 0 0") + point("rod", "0 -1 0")) +
                                          muscle("\xc3\xa9", point("/ground", "1 0 0") + point("rod", "0 -1 0"))));
  EXPECT_EQ(model.muscles[0].name, "\xc3\xa9\xc3\xbf");
  EXPECT_EQ(model.muscles[1].name, "\xc3\xa9");
}

TEST(ModelReader, a_document_of_a_later_version_is_read_and_told) {
  const Model model = model_from(document(
      set("BodySet", body("rod")) + set("JointSet", joint("WeldJoint", "fixed", "/ground", "rod", "")), "50000"));
  ASSERT_EQ(model.unsupported.size(), 1u);
  EXPECT_THAT(model.unsupported[0], HasSubstr("document version 50000"));
}

TEST(ModelReader, entities_stay_as_they_are_written) {
  const std::string bomb =
      "<!DOCTYPE x [<!ENTITY a \"aaaaaaaa\"><!ENTITY b \"&a;&a;&a;\"><!ENTITY f SYSTEM \"file:///etc/passwd\">]>" +
      document(set("BodySet", body("&b;") + body("&f;")) +
               set("JointSet",
                   joint("WeldJoint", "j", "/ground", "&b;", "") + joint("WeldJoint", "k", "/ground", "&f;", "")))
          .substr(std::string("<?xml version=\"1.0\" encoding=\"UTF-8\" ?>").size());
  const Model model = model_from(bomb);
  EXPECT_EQ(model.bodies[1].name, "&b;");
  EXPECT_EQ(model.bodies[2].name, "&f;");
}

TEST(ModelReader, refuses_wrap_objects_without_size) {
  const auto with = [](const std::string& object) {
    return complaint_about(
        pendulum(muscle("m", point("/ground", "1 0 0") + point("rod", "0 -1 0")), set("WrapObjectSet", object)));
  };
  EXPECT_THAT(with("<WrapSphere name=\"w\"><radius>0</radius></WrapSphere>"), HasSubstr("must be above zero"));
  EXPECT_THAT(with("<WrapSphere name=\"w\"><radius>1e300</radius></WrapSphere>"), HasSubstr("below 1,000,000 m"));
  EXPECT_THAT(with("<WrapEllipsoid name=\"w\"><dimensions>1e300 1 1</dimensions></WrapEllipsoid>"),
              HasSubstr("below 1,000,000 m"));
  EXPECT_THAT(with("<WrapCylinder name=\"w\"><radius>nan</radius></WrapCylinder>"), HasSubstr("radius"));
  EXPECT_THAT(with("<WrapEllipsoid name=\"w\"><dimensions>1 0 1</dimensions></WrapEllipsoid>"),
              HasSubstr("three radii above zero"));
  EXPECT_THAT(with("<WrapTorus name=\"w\"><inner_radius>2</inner_radius><outer_radius>1</outer_radius></WrapTorus>"),
              HasSubstr("the outer one must be larger"));
  EXPECT_THAT(with("<WrapCylinderObst name=\"w\"><radius>1</radius><wrapDirection>up</wrapDirection>"
                   "</WrapCylinderObst>"),
              HasSubstr("use righthand or lefthand"));
  EXPECT_THAT(with("<WrapDoubleCylinderObst name=\"w\"><wrapVcylHomeBodyName>moon</wrapVcylHomeBodyName>"
                   "</WrapDoubleCylinderObst>"),
              HasSubstr("'moon', which does not exist"));
}

TEST(ModelReader, the_walking_model_has_92_muscles) {
  GRACILIS_NEEDS_DATA("opensim");
  const Model model = read_model(data_root() / "opensim/subject01_simbody_adjusted_StaticOp.osim");
  EXPECT_EQ(model.muscles.size(), 92u);
  EXPECT_EQ(model.coordinates.size(), 23u);
  EXPECT_EQ(model.bodies.size(), 13u);
  EXPECT_TRUE(model.unsupported.empty()) << model.unsupported.front();
  EXPECT_FALSE(model.coordinates[3].rotation);  // pelvis_tx
}

TEST(ModelReader, the_cadaver_hip_has_8_muscles_and_bones_in_millimetres) {
  GRACILIS_NEEDS_DATA("lhdl-hip");
  const Model model = read_model(data_root() / "lhdl-hip/motion/LHDL_hip_r.osim");
  EXPECT_EQ(model.muscles.size(), 8u);
  ASSERT_EQ(model.bodies[1].geometry.size(), 1u);
  EXPECT_EQ(model.bodies[1].geometry[0].file, "geometry/LHDL_pelvis.vtp");
  EXPECT_NEAR(model.bodies[1].geometry[0].scale.x(), 0.001, 1e-15);
}

TEST(ModelReader, paths_that_go_up_name_what_holds_them) {
  const std::string frame =
      "<components><PhysicalOffsetFrame name=\"off\"><socket_parent>..</socket_parent><translation>0 -0.1 "
      "0</translation></PhysicalOffsetFrame></components>";
  const Model model = model_from(
      pendulum(muscle("m", point("/ground", "1 0 0") + point("/bodyset/rod/off", "0 -1 0")) +
                   muscle("n", point("../../../../../ground", "1 0 0") + point("/bodyset/other/../rod", "0 -1 0")),
               frame));
  EXPECT_EQ(model.muscles[0].path.points[1].body, 1);
  EXPECT_NEAR(model.muscles[0].path.points[1].location.y(), -1.1, 1e-12);
  EXPECT_EQ(model.muscles[1].path.points[0].body, 0);
  EXPECT_EQ(model.muscles[1].path.points[1].body, 1);
}

TEST(ModelReader, documents_of_opensim_1_and_2_are_read_by_what_changed_since) {
  const std::string points =
      "<MusclePointSet><objects><MusclePoint name=\"a\"><location>1 0 0</location><body>ground</body></MusclePoint>"
      "<MuscleViaPoint name=\"b\"><location>0.5 0 0</location><body>ground</body><range>-1 1</range>"
      "<coordinate>swing</coordinate></MuscleViaPoint><MusclePoint name=\"c\"><location>0 -1 "
      "0</location><body>rod</body>"
      "</MusclePoint></objects></MusclePointSet>";
  const std::string old_joint =
      "<Joint><PinJoint name=\"hinge\"><parent_body>ground</parent_body><CoordinateSet><objects>" +
      coordinate("swing") + "</objects></CoordinateSet></PinJoint></Joint>";
  for (const char* version : {"10905", "20303"}) {
    const Model model =
        model_from(document("<DynamicsEngine><SimbodyEngine name=\"e\">" + set("BodySet", body("rod", old_joint)) +
                                "</SimbodyEngine></DynamicsEngine>" +
                                set("ActuatorSet", "<Thelen2003Muscle name=\"m\">" + points + "</Thelen2003Muscle>"),
                            version));
    ASSERT_EQ(model.muscles.size(), 1u) << version;
    EXPECT_EQ(model.muscles[0].path.points.size(), 3u);
    EXPECT_EQ(model.muscles[0].path.points[1].condition, 0);
    EXPECT_THAT(model.unsupported.at(0), HasSubstr("read as one of OpenSim 3"));
  }
}

TEST(ModelReader, a_force_set_that_repeats_a_name_replaces_that_force_and_says_so) {
  Model model = model_from(pendulum(muscle("m", point("/ground", "1 0 0") + point("rod", "0 -1 0")) +
                                    "<CoordinateActuator name=\"swing_reserve\"><coordinate>swing</coordinate>"
                                    "<optimal_force>1</optimal_force></CoordinateActuator>"));
  const TestFolder folder;
  read_force_set(folder.write("more.xml",
                              "<OpenSimDocument Version=\"30000\"><ForceSet><objects>"
                              "<CoordinateActuator name=\"swing_reserve\"><coordinate>swing</coordinate>"
                              "<optimal_force>100</optimal_force></CoordinateActuator></objects></ForceSet>"
                              "</OpenSimDocument>"),
                 false, model);
  ASSERT_EQ(model.actuators.size(), 1u);
  EXPECT_EQ(model.actuators[0].optimal_force, 100);
  EXPECT_EQ(model.muscles.size(), 1u);
  EXPECT_THAT(model.unsupported.at(0), HasSubstr("'swing_reserve': replaces the force"));
}

}  // namespace gracilis::opensim
