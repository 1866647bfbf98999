#include <gracilis/io/scene/scene_layers.hpp>
#include <gracilis/io/scene/scene_reader.hpp>

#include "io/scene_reader_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

namespace gracilis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Seconds, not the minutes that pairs of all entries take.
class ManyEntries : public SceneReader {
 protected:
  void TearDown() override { EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(15)); }

  const std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
};

std::string named_entries(int count, const std::string& more) {
  std::string text;
  for (int i = 0; i < count; ++i) text += fmt::format("[[activations]]\nname = \"a{}\"\n{}", i, more);
  return text;
}

/// A chain of joints below the femur, written from its end on.
std::string chain(int count) {
  std::string text;
  for (int i = count - 1; i >= 0; --i)
    text += fmt::format("[[joints]]\nname = \"j{}\"\nparent = \"{}\"\nchild = \"b{}\"\ncenter = [0, 0, 0]\n", i,
                        i == 0 ? "femur" : fmt::format("b{}", i - 1), i);
  return text;
}

TEST_F(ManyEntries, lists_of_tens_of_thousands_of_names_are_laid_over_each_other) {
  folder.write("low.toml", named_entries(30'000, "muscle = \"low\"\n"));
  const auto file = folder.write("up.toml", "include = \"low.toml\"\n" + named_entries(30'001, "rise = 1\n"));
  const SceneLayers layers = load_scene_layers(file, {});
  const toml::array& entries = *layers.table["activations"].as_array();
  ASSERT_EQ(entries.size(), 30'001u);
  const toml::table& last = *entries[29'999].as_table();
  EXPECT_EQ(last["muscle"].value_or(std::string()), "low");
  EXPECT_EQ(last["rise"].value_or(0), 1);
}

TEST_F(ManyEntries, thousands_of_joints_may_stand_children_first) {
  const std::string text = with(good_scene(), "file = \"pelvis.ply\"", "file = \"none.ply\"");
  EXPECT_THAT(problems(text + chain(3000)), HasSubstr("none.ply"));  // joints are placed before files are looked for
}

TEST_F(ManyEntries, joints_come_in_the_order_of_the_file_as_far_as_parents_allow) {
  std::vector<std::string> names;
  for (const Joint& joint : read(good_scene() + chain(3)).scene.joints) names.push_back(joint.name);
  EXPECT_THAT(names, ElementsAre("hip", "j0", "j1", "j2"));
}

TEST_F(ManyEntries, cells_beyond_all_numbers_are_no_negative_number_of_triangles) {
  const std::string box = "box = { size_mm = [10, 10, 10], cells = [1e300, 1, 1] }";
  const std::string message = problems(with(good_scene(), "file = \"pelvis.ply\"\nunit = \"mm\"", box));
  EXPECT_THAT(message, HasSubstr("'cells' must be three integers from 1 to 1000"));
  EXPECT_THAT(message, Not(HasSubstr("triangles")));
}

}  // namespace
}  // namespace gracilis
