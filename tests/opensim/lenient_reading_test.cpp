#include "opensim/model_texts.hpp"

#include <gracilis/opensim/kinematics/skeleton.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <limits>

/// Where OpenSim goes on, we go on, too, and tell.
namespace gracilis::opensim {

using testing::Contains;
using testing::HasSubstr;

TEST(LenientReading, a_body_on_no_joint_gets_a_free_one_to_the_ground) {
  const Model model = model_from(document(set("BodySet", body("rod"))));
  EXPECT_THAT(model.unsupported, testing::ElementsAre(HasSubstr("body 'rod' hangs on no joint")));
  ASSERT_EQ(model.joints.size(), 1u);
  EXPECT_EQ(model.joints[0].type, "FreeJoint");
  EXPECT_THAT(names_of(model.coordinates),
              testing::ElementsAre("free_rod_coord_0", "free_rod_coord_1", "free_rod_coord_2", "free_rod_coord_3",
                                   "free_rod_coord_4", "free_rod_coord_5"));
  EXPECT_TRUE(model.coordinates[2].rotation);
  EXPECT_FALSE(model.coordinates[3].rotation);
  Skeleton skeleton(model);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
  q[4] = 0.3;
  skeleton.place(q);
  EXPECT_TRUE(skeleton.poses()[1].translation().isApprox(Vec3(0, 0.3, 0), 1e-14));
}

TEST(LenientReading, coordinates_that_only_axes_of_a_joint_name_move_it_all_the_same) {
  const std::string axes =
      "<SpatialTransform><TransformAxis name=\"rotation1\"><coordinates>swing</coordinates><axis>0 0 1</axis>"
      "</TransformAxis><TransformAxis name=\"translation2\"><coordinates>way swing</coordinates><axis>0 1 0</axis>"
      "<MultivariatePolynomialFunction><dimension>2</dimension><order>1</order><coefficients>0 0.5 1</coefficients>"
      "</MultivariatePolynomialFunction></TransformAxis></SpatialTransform>";
  const Model model = model_from(document(set("BodySet", body("rod")) +
                                          set("JointSet", joint("CustomJoint", "hinge", "/ground", "rod", "", axes))));
  EXPECT_THAT(names_of(model.coordinates), testing::ElementsAre("swing", "way"));
  EXPECT_TRUE(model.coordinates[0].rotation);
  EXPECT_FALSE(model.coordinates[1].rotation);
  EXPECT_THAT(model.joints[0].axes[4].coordinates, testing::ElementsAre(1, 0));
  EXPECT_THAT(model.unsupported, Contains(HasSubstr("leaves out coordinates, which are called swing, way")));
  Skeleton skeleton(model);
  skeleton.place(Eigen::Vector2d(pi / 2, 0.1));
  EXPECT_TRUE((skeleton.poses()[1].linear() * Vec3::UnitX()).isApprox(Vec3::UnitY(), 1e-12));
}

TEST(LenientReading, coordinates_that_a_joint_leaves_out_move_it_all_the_same) {
  const Model model =
      model_from(document(set("BodySet", body("rod") + body("tip")) +
                          set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", "") +
                                              joint("SliderJoint", "rail", "/bodyset/rod", "tip", ""))));
  EXPECT_THAT(names_of(model.coordinates), testing::ElementsAre("hinge_coord_0", "rail_coord_0"));
  EXPECT_TRUE(model.coordinates[0].rotation);
  EXPECT_FALSE(model.coordinates[1].rotation);
  EXPECT_THAT(model.joints[0].axes[2].coordinates, testing::ElementsAre(0));
  EXPECT_THAT(model.unsupported, Contains(HasSubstr("leaves out coordinates, which are called hinge_coord_0")));
}

/// Two links, each with wrap objects of its own, and a muscle around "around".
static Model wrapped_links(const std::string& on_rod, const std::string& on_tip, const std::string& more = "") {
  return model_from(document(
      set("BodySet", body("rod", set("WrapObjectSet", on_rod)) + body("tip", set("WrapObjectSet", on_tip))) +
      set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", coordinate("swing")) +
                          joint("PinJoint", "knee", "/bodyset/rod", "tip", coordinate("bend"), "", "0 -0.5 0")) +
      set("ForceSet", muscle("m", point("/ground", "0.3 0 0") + point("/bodyset/tip", "0 -0.4 0"), "",
                             "<PathWrap name=\"w\"><wrap_object>around</wrap_object>" + more + "</PathWrap>"))));
}

static std::string roll(const std::string& radius, const std::string& more = "") {
  return "<WrapCylinder name=\"around\"><radius>" + radius + "</radius><length>1</length>" + more + "</WrapCylinder>";
}

TEST(LenientReading, of_two_wrap_objects_of_one_name_the_first_counts) {
  const Model model = wrapped_links(roll("0.1"), roll("0.2"));
  EXPECT_THAT(model.unsupported, testing::ElementsAre(HasSubstr("'around': has the name of another wrap object")));
  const Path& path = model.muscles.at(0).path;
  ASSERT_EQ(path.wraps.size(), 1u);
  EXPECT_EQ(model.wrap_objects[static_cast<std::size_t>(path.wraps[0].object)].surface.radius, 0.1);
}

TEST(LenientReading, an_inactive_wrap_object_is_no_reason_to_warn) {
  const Model model = wrapped_links(roll("0.1", "<active>false</active>"), "");
  EXPECT_THAT(model.unsupported, testing::IsEmpty());
  EXPECT_TRUE(model.muscles.at(0).path.wraps.empty());
  EXPECT_FALSE(model.muscles[0].path.approximate);
}

TEST(LenientReading, methods_and_quadrants_of_wrapping_may_have_capitals) {
  const auto plane = [](const std::string& method) {
    const Model model = wrapped_links(roll("0.1", "<quadrant>-Y</quadrant>"), "", "<method>" + method + "</method>");
    EXPECT_THAT(model.unsupported, testing::IsEmpty());
    EXPECT_EQ(model.wrap_objects.at(0).surface.side_axis, 1);
    EXPECT_EQ(model.wrap_objects[0].surface.side_sign, -1);
    return model.muscles.at(0).path.wraps.at(0).plane;
  };
  EXPECT_EQ(plane("Midpoint"), WrapSurface::Plane::midpoint);
  EXPECT_EQ(plane("HYBRID"), WrapSurface::Plane::hybrid);
  EXPECT_EQ(plane("Axial"), WrapSurface::Plane::axial);
}

TEST(LenientReading, a_force_that_cannot_be_read_is_left_out_and_the_others_are_there) {
  const std::string way = point("/ground", "1 0 0") + point("rod", "0 -1 0");
  const std::pair<std::string, std::string> bad[] = {
      {muscle("m", way, "<optimal_fiber_length>0</optimal_fiber_length>"),
       "'m': left out: <optimal_fiber_length> is 0"},
      {muscle("m", way, "<max_isometric_force>-1</max_isometric_force>"), "'m': left out: <max_isometric_force> is -1"},
      {muscle("m", point("rod", "0 0 0")), "'m': left out: has a path with less than two points"},
      {muscle("m", point("rod", "0 zero 0") + way), "'m': left out: <location> holds 'zero', which is not a number"},
      {muscle("m", point("/ground", "inf 0 0") + way), "'inf', which is not finite"},
      {muscle("", way), "Muscle '': left out: has no name"},
      {muscle("m", way, "<appliesForce>maybe</appliesForce>"), "'m': left out: <appliesForce> is 'maybe'"},
      {"<CoordinateActuator name=\"m\"><coordinate>twist</coordinate></CoordinateActuator>",
       "'m': left out: names the coordinate 'twist', which does not exist"}};
  for (const auto& [force, told] : bad) {
    const Model model = model_from(pendulum(muscle("good", way) + force + muscle("best", way)));
    EXPECT_THAT(names_of(model.muscles), testing::ElementsAre("good", "best")) << told;
    EXPECT_TRUE(model.actuators.empty());
    EXPECT_THAT(model.unsupported, testing::ElementsAre(HasSubstr(told)));
    EXPECT_EQ(model.missing_forces.size(), 1u) << told;
  }
}

TEST(LenientReading, a_hundred_thousand_unknown_forces_are_each_told_once_within_seconds) {
  std::string forces = "<Thruster name=\"t\"/><Thruster name=\"t\"/>";
  for (int i = 0; i < 100000; ++i) forces += "<Thruster name=\"t" + std::to_string(i) + "\"/>";
  const auto begin = std::chrono::steady_clock::now();
  const Model model = model_from(pendulum(forces));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));  // some tenths; 20 s before
  EXPECT_EQ(model.unsupported.size(), 100001u);
}

TEST(LenientReading, a_force_that_cannot_be_read_takes_no_other_s_place) {
  const std::string way = point("/ground", "1 0 0") + point("rod", "0 -1 0");
  Model model = model_from(pendulum(muscle("m", way)));
  const TestFolder folder;
  read_force_set(
      folder.write("more.xml", "<OpenSimDocument Version=\"40000\">" +
                                   set("ForceSet", muscle("m", point("rod", "0 0 0"))) + "</OpenSimDocument>"),
      false, model);
  EXPECT_EQ(model.muscles.size(), 1u);
}

TEST(LenientReading, points_of_a_force_set_lie_in_the_model_s_frames) {
  const std::string frame =
      "<components><PhysicalOffsetFrame name=\"off\"><socket_parent>..</socket_parent><translation>0 -0.1 0"
      "</translation></PhysicalOffsetFrame></components>";
  Model model = model_from(pendulum("", frame));
  const TestFolder folder;
  const std::string way = point("/ground", "1 0 0") + point("/bodyset/rod/off", "0 -1 0");
  read_force_set(folder.write("more.xml", "<OpenSimDocument Version=\"40000\">" + set("ForceSet", muscle("m", way)) +
                                              "</OpenSimDocument>"),
                 false, model);
  ASSERT_EQ(model.muscles.size(), 1u);
  EXPECT_NEAR(model.muscles[0].path.points[1].location.y(), -1.1, 1e-12);
}

static std::string coupler(const std::string& dependent, const std::string& independent, const std::string& line) {
  return "<CoordinateCouplerConstraint name=\"" + dependent +
         "_coupler\"><coupled_coordinates_function><LinearFunction><coefficients>" + line +
         "</coefficients></LinearFunction></coupled_coordinates_function><independent_coordinate_names>" + independent +
         "</independent_coordinate_names><dependent_coordinate_name>" + dependent +
         "</dependent_coordinate_name></CoordinateCouplerConstraint>";
}

static Model coupled(const std::string& couplers) {
  return model_from(document(
      set("BodySet", body("one") + body("two") + body("three")) +
      set("JointSet", joint("PinJoint", "first", "/ground", "one", coordinate("a", "0.5")) +
                          joint("PinJoint", "second", "/bodyset/one", "two", coordinate("b"), "", "0 -0.5 0") +
                          joint("PinJoint", "third", "/bodyset/two", "three", coordinate("c"), "", "0 -0.5 0")) +
      set("ConstraintSet", couplers)));
}

TEST(LenientReading, couplers_hold_in_whatever_order_they_are_written) {
  const Model model = coupled(coupler("c", "b", "1 1") + coupler("b", "a", "2 0"));
  EXPECT_THAT(model.unsupported, testing::IsEmpty());
  const Eigen::VectorXd q = default_coordinates(model);
  EXPECT_EQ(q[1], 1);
  EXPECT_EQ(q[2], 2);
  // A force on the last works through both.
  EXPECT_EQ(onto_independent(model, q, Eigen::Vector3d(0, 0, 3)), Eigen::VectorXd(Eigen::Vector3d(6, 0, 0)));
}

TEST(LenientReading, couplers_in_a_circle_are_told) {
  const Model model = coupled(coupler("c", "b", "1 1") + coupler("b", "c", "2 0"));
  EXPECT_EQ(model.couplers.size(), 2u);
  EXPECT_THAT(model.unsupported, testing::ElementsAre(HasSubstr("the coupler 'c_coupler' is part of a circle")));
}

TEST(LenientReading, what_a_force_lacks_is_told_and_the_model_is_read) {
  const std::string way = point("/ground", "1 0 0") + point("rod", "0 -1 0");
  const Model model =
      model_from(pendulum("<NobodysForce><strength>1</strength></NobodysForce>" +
                          muscle("lost", point("/ground", "1 0 0") + point("/body", "0 -1 0")) +
                          muscle("still", way, "<max_contraction_velocity>0</max_contraction_velocity>")));
  ASSERT_EQ(model.muscles.size(), 1u);
  EXPECT_EQ(model.muscles[0].name, "still");
  EXPECT_EQ(model.muscles[0].max_contraction_velocity, 10);
  ASSERT_EQ(model.unsupported.size(), 3u);
  EXPECT_THAT(model.unsupported[1], HasSubstr("'lost': has a point on '/body', which does not exist"));
}

TEST(LenientReading, a_joint_of_no_bodies_is_left_out) {
  const Model model = model_from(document(
      set("BodySet", body("rod")) +
      set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", coordinate("swing")) +
                          "<PinJoint name=\"nothing\"><socket_parent_frame></socket_parent_frame></PinJoint>")));
  EXPECT_EQ(model.joints.size(), 1u);
  EXPECT_THAT(model.unsupported.at(0), HasSubstr("'nothing': names no bodies"));
}

TEST(LenientReading, a_joint_that_names_one_body_alone_is_left_out) {
  // By an empty name of its frame, as versions from 4 have it, and up to 3.2.
  const Model model =
      model_from(document(set("BodySet", body("rod") + body("lost")) +
                          set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", coordinate("swing")) +
                                              joint("PinJoint", "half", "", "lost", coordinate("none")))));
  EXPECT_EQ(model.joints.size(), 2u);
  EXPECT_THAT(model.unsupported.at(0), HasSubstr("'half': names no bodies, or one alone"));
  const Model old = model_from(document(
      set("BodySet", body("rod", "<Joint><PinJoint name=\"half\"><parent_body></parent_body></PinJoint></Joint>")),
      "30000"));
  EXPECT_EQ(old.joints.at(0).type, "FreeJoint");
}

TEST(LenientReading, truth_is_told_in_capitals_too_as_simbody_reads_it) {
  const Model model = model_from(document(
      set("BodySet", body("rod")) +
      set("JointSet", joint("PinJoint", "hinge", "/ground", "rod",
                            "<Coordinate name=\"swing\"><locked>TRUE</locked><clamped>False</clamped></Coordinate>"))));
  EXPECT_TRUE(model.coordinates.at(0).locked);
  EXPECT_FALSE(model.coordinates.at(0).clamped);
}

TEST(LenientReading, a_body_whose_name_begins_with_a_slash_is_found) {
  const Model model = model_from(document(
      set("BodySet", body("/rod")) + set("JointSet",
                                         "<PinJoint name=\"hinge\"><socket_parent_frame>/ground</socket_parent_frame>"
                                         "<socket_child_frame>/rod</socket_child_frame></PinJoint>")));
  EXPECT_EQ(model.joints.at(0).child_body, 1);
}

TEST(LenientReading, a_range_may_be_endless_and_one_that_ends_before_it_begins_is_turned_round) {
  const auto swing = [](const std::string& range) {
    return "<Coordinate name=\"swing\"><range>" + range + "</range></Coordinate>";
  };
  const auto read = [&](const std::string& range) {
    return model_from(document(set("BodySet", body("rod")) +
                               set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", swing(range)))));
  };
  EXPECT_EQ(read("-1e308 1e308").coordinates.at(0).range_max, std::numeric_limits<Real>::infinity());
  const Model turned = read("1 -2");
  EXPECT_EQ(turned.coordinates.at(0).range_min, -2);
  EXPECT_EQ(turned.coordinates.at(0).range_max, 1);
  EXPECT_THAT(turned.unsupported.at(0), HasSubstr("ends before it begins"));
}

TEST(LenientReading, joints_on_an_ellipsoid_get_the_coordinates_that_the_file_leaves_out) {
  const auto read = [](const std::string& kind, const std::string& radii) {
    return model_from(
        document(set("BodySet", body("rod")) + set("JointSet", joint(kind, "glide", "/ground", "rod", "", radii))));
  };
  EXPECT_EQ(read("EllipsoidJoint", "<radii_x_y_z>1 2 3</radii_x_y_z>").coordinates.size(), 3u);
  EXPECT_EQ(read("ScapulothoracicJoint", "<thoracic_ellipsoid_radii_x_y_z>1 2 3</thoracic_ellipsoid_radii_x_y_z>")
                .coordinates.size(),
            4u);
}

}  // namespace gracilis::opensim
