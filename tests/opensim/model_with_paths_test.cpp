#include "opensim/model_texts.hpp"

#include <gracilis/opensim/export/model_with_paths.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis::opensim {

/// A pendulum with "m" along these elements, and "after" behind it.
static std::string model_along(const std::string& path) {
  const std::string way = point("/ground", "0.1 0 0") + point("/bodyset/rod", "0 -0.3 0");
  return pendulum("<Thelen2003Muscle name=\"m\">" + path + "</Thelen2003Muscle>" + muscle("after", way));
}

static std::string model_with_another_path(const std::string& text) {
  const TestFolder folder;
  const auto file = folder.write("model.osim", text);
  const Model model = read_model(file);
  Muscle moved = model.muscles.at(0);
  moved.path.points.at(1).location = Vec3(0, -0.25, 0);
  moved.tendon_slack_length = 0.123;
  return model_with_paths(file, model, {moved});
}

/// That what is written is a whole model along the other path. Where it is not, says how.
static testing::AssertionResult has_both_muscles(const std::string& text) {
  const Model model = model_from(text, "after.osim");
  if (model.muscles.size() != 2) return testing::AssertionFailure() << text;
  const Muscle& muscle = model.muscles[0];
  if (muscle.path.points.at(1).location != Vec3(0, -0.25, 0) || muscle.tendon_slack_length != 0.123)
    return testing::AssertionFailure() << text;
  return testing::AssertionSuccess();
}

static const std::string two_points =
    "<objects>" + point("/ground", "0.1 0 0") + point("/bodyset/rod", "0 -0.3 0") + "</objects>";

TEST(ModelWithPath, an_end_tag_may_hold_white_space) {
  EXPECT_TRUE(has_both_muscles(model_with_another_path(
      model_along("<GeometryPath><PathPointSet >" + two_points + "</PathPointSet\n ></GeometryPath>"))));
}

TEST(ModelWithPath, an_end_tag_in_a_comment_a_section_or_an_attribute_ends_nothing) {
  const std::string odd = "<!-- > </PathPointSet> \" --><![CDATA[</PathPointSet>]]><?x </PathPointSet>?>";
  const std::string text = model_along("<GeometryPath><PathPointSet name='a > \" />'>" + odd + two_points +
                                       "</PathPointSet><PathWrapSet name=\"none\" /></GeometryPath><!--kept-->");
  const std::string after = model_with_another_path(text);
  EXPECT_TRUE(has_both_muscles(after));
  EXPECT_THAT(after, testing::HasSubstr("</GeometryPath><!--kept-->"));
  EXPECT_THAT(after, testing::Not(testing::HasSubstr("CDATA")));
}

TEST(ModelWithPath, a_path_may_stand_in_an_element_of_its_own) {
  const std::string after = model_with_another_path(
      model_along("<path><GeometryPath><PathPointSet>" + two_points + "</PathPointSet></GeometryPath></path>"));
  EXPECT_TRUE(has_both_muscles(after));
  EXPECT_THAT(after, testing::HasSubstr("</tendon_slack_length><path><GeometryPath>"));
}

TEST(ModelWithPath, a_muscle_along_a_function_is_refused_by_its_name) {
  const TestFolder folder;
  const auto file = folder.write(
      "model.osim", model_along("<FunctionBasedPath><coordinate_paths>swing</coordinate_paths><length_function>"
                                "<LinearFunction><coefficients>0.1 0.3</coefficients></LinearFunction>"
                                "</length_function></FunctionBasedPath>"));
  const Model model = read_model(file);
  ASSERT_EQ(model.muscles.size(), 2u) << testing::PrintToString(model.unsupported);
  EXPECT_THAT(message_of_input_error([&] { model_with_paths(file, model, {model.muscles[0]}); }),
              testing::AllOf(testing::HasSubstr("Thelen2003Muscle 'm'"), testing::HasSubstr("no GeometryPath")));
}

}  // namespace gracilis::opensim
