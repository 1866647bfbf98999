#include "opensim/model_texts.hpp"

#include <gracilis/opensim/export/muscle_element.hpp>
#include <gracilis/opensim/export/muscle_text.hpp>
#include <gracilis/opensim/export/run_paths.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis::opensim {

using testing::HasSubstr;

/// A muscle with more to it than its five first parameters, some of it among the defaults.
static std::string rich_model(const std::string& version) {
  const std::string rest =
      "<tendon_slack_length>0.2</tendon_slack_length><KshapeActive>0.7</KshapeActive><max_control>0.8</max_control>"
      "<ignore_tendon_compliance>true</ignore_tendon_compliance><appliesForce>false</appliesForce>";
  const std::string around = "<PathWrap name=\"w\"><wrap_object>roll</wrap_object></PathWrap>";
  return document(
      "<defaults><Thelen2003Muscle name=\"default\"><Flen>1.9</Flen><KshapeActive>0.1</KshapeActive></Thelen2003Muscle>"
      "</defaults>" +
          set("BodySet", body("rod", set("WrapObjectSet",
                                         "<WrapSphere name=\"roll\"><radius>0.02</radius>"
                                         "</WrapSphere>"))) +
          set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", coordinate("swing"))) +
          set("ForceSet",
              muscle("a &amp; b", point("/ground", "0.3 0 0") + point("/bodyset/rod", "0 -0.4 0"), rest, around)),
      version);
}

/// The muscle of the rich model through other points, the second of which moves.
static Muscle moved_muscle(const Model& model) {
  Muscle moved = model.muscles.at(0);
  moved.tendon_slack_length = 0.31;
  moved.path = {};
  moved.path.points.resize(2);
  moved.path.points[0].location = Vec3(0.5, 0, 0);
  moved.path.points[1].body = 1;
  moved.path.points[1].moving = true;
  moved.path.points[1].moves_with = {0, -1, -1};
  moved.path.points[1].moves_to = {simm_spline({0, 1}, {0, 0.1}), constant(-0.4), constant(0)};
  return moved;
}

static void expect_all_but_path(const Muscle& read) {
  EXPECT_EQ(read.name, "a & b");
  EXPECT_EQ(read.active_shape, 0.7);
  EXPECT_EQ(read.eccentric_force, 1.9);
  EXPECT_EQ(read.max_control, 0.8);
  EXPECT_TRUE(read.ignore_tendon_compliance);
  EXPECT_FALSE(read.applies_force);
}

TEST(MuscleElement, a_muscle_along_other_points_keeps_all_that_its_file_says) {
  const TestFolder folder;
  const auto path = folder.write("m.osim", rich_model("40000"));
  const Model model = read_model(path);
  const Model read =
      model_from(pendulum(own_muscle_text_along(read_xml(path), model, moved_muscle(model))), "again.osim");
  ASSERT_EQ(read.muscles.size(), 1u);
  expect_all_but_path(read.muscles[0]);
  EXPECT_EQ(read.muscles[0].tendon_slack_length, 0.31);
  ASSERT_EQ(read.muscles[0].path.points.size(), 2u);
  EXPECT_EQ(read.muscles[0].path.points[0].location, Vec3(0.5, 0, 0));
  EXPECT_TRUE(read.muscles[0].path.points[1].moving);
  EXPECT_TRUE(read.muscles[0].path.wraps.empty());
}

TEST(MuscleElement, one_that_keeps_its_path_is_written_as_it_stands) {
  const TestFolder folder;
  const auto path = folder.write("m.osim", rich_model("40000"));
  const std::string text = own_muscle_text(read_xml(path), "a & b");
  EXPECT_THAT(text, HasSubstr("<wrap_object>roll</wrap_object>"));
  Model read = read_model(path);
  read_force_set(
      folder.write("set.xml", "<OpenSimDocument Version=\"40000\">" + set("ForceSet", text) + "</OpenSimDocument>"),
      true, read);
  ASSERT_EQ(read.muscles.size(), 1u);
  expect_all_but_path(read.muscles[0]);
  EXPECT_EQ(read.muscles[0].path.points.size(), 2u);
  EXPECT_EQ(read.muscles[0].path.wraps.size(), 1u);
}

TEST(MuscleElement, of_a_model_of_version_3_has_points_as_that_has_them) {
  const TestFolder folder;
  const auto path = folder.write("m.osim", rich_model("30000"));
  const Model model = read_model(path);
  const std::string text = own_muscle_text_along(read_xml(path), model, moved_muscle(model));
  EXPECT_THAT(text, HasSubstr("<body>rod</body>"));
  EXPECT_THAT(text, HasSubstr("<x_coordinate>swing</x_coordinate>"));
  EXPECT_THAT(text, testing::Not(HasSubstr("socket")));
}

TEST(ExportedNames, are_written_as_xml_has_them) {
  const Model model = model_from(pendulum());
  Muscle muscle;
  muscle.name = "a<b & \"c\"";
  muscle.path.points.resize(2);
  muscle.path.points[0].name = "p&q";
  const Model read = model_from(pendulum(muscle_text(model, muscle)), "again.osim");
  ASSERT_EQ(read.muscles.size(), 1u);
  EXPECT_EQ(read.muscles[0].name, muscle.name);
  EXPECT_EQ(read.muscles[0].path.points[0].name, "p&q");
  FittedMuscle fitted;
  fitted.name = muscle.name;
  fitted.coordinates = {0};
  fitted.length.coefficients = {0.5, 0.1};
  fitted.length.order = 1;
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(function_path_set(model, {fitted}).c_str()));
  const pugi::xml_node path =
      document.document_element().child("Set_FunctionBasedPath_").child("objects").child("FunctionBasedPath");
  EXPECT_EQ(name_of(path), "/forceset/" + muscle.name);
}

}  // namespace gracilis::opensim
