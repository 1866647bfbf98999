#include <gracilis/io/scene/scene_layers.hpp>

#include "io/scene_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {
namespace {

using testing::HasSubstr;

/// Scene files that ask for more than a person would write.
class Nesting : public testing::Test {
 protected:
  std::string refused(const std::string& text, const std::vector<std::string>& set = {}) const {
    try {
      load_scene_layers(folder.write("scene.toml", text), set);
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "no problem";
  }

  SceneFolder folder;
};

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

TEST_F(Nesting, keys_of_many_parts_are_refused_and_not_walked_through) {
  EXPECT_THAT(refused("schema = 1\n" + repeated("a.", 200'000) + "b = 1\n"),
              HasSubstr("scene.toml:2: a key has more than 16 parts"));
  EXPECT_THAT(refused("[" + repeated("a.", 200'000) + "b]\n"), HasSubstr("a key has more than 16 parts"));
  EXPECT_THAT(refused("[" + repeated("\"x\".", 200'000) + "b]\n"), HasSubstr("a key has more than 16 parts"));
  EXPECT_THAT(refused("a = {" + repeated("a . ", 200'000) + "b = 1}\n"), HasSubstr("a key has more than 16 parts"));
  EXPECT_THAT(refused("schema = 1\n", {repeated("a.", 200'000) + "b=1"}), HasSubstr("the scene has no muscle"));
  EXPECT_THAT(refused("schema = 1\n", {"iterations={" + repeated("a.", 200'000) + "b=1}"}),
              HasSubstr("a key has more than 16 parts"));
}

TEST_F(Nesting, texts_and_comments_hide_no_key_and_are_none) {
  EXPECT_THAT(refused("a = \"\"\"say \"it's\" # so\"\"\"\n" + repeated("a.", 200) + "b = 1\n"),
              HasSubstr("scene.toml:2: a key"));
  EXPECT_THAT(refused("a = 'it\\'\n" + repeated("a.", 200) + "b = 1\n"), HasSubstr("scene.toml:2: a key"));
  const std::string dots = repeated("a.", 50);
  EXPECT_EQ(refused("# " + dots + "\na = \"" + dots + "\"\nb = '''\n" + dots + "\n'''\nc = [1.0, 2.0, 3.0]\n"),
            "no problem");
}

TEST_F(Nesting, arrays_in_arrays_end_somewhere) {
  EXPECT_NE(refused("a = " + repeated("[", 20'000) + "\n"), "no problem");
  EXPECT_NE(refused("a = " + repeated("{a = ", 20'000) + "\n"), "no problem");
}

TEST_F(Nesting, a_chain_of_includes_ends_somewhere) {
  for (int i = 1; i < 60; ++i)
    folder.write("part" + std::to_string(i) + ".toml", "include = \"part" + std::to_string(i + 1) + ".toml\"\n");
  folder.write("part60.toml", "schema = 1\n");
  EXPECT_THAT(refused("include = \"part1.toml\"\n"), HasSubstr("is included by way of more than 32 files"));
  EXPECT_EQ(refused("include = \"part40.toml\"\n"), "no problem");
}

TEST_F(Nesting, includes_that_double_end_somewhere) {
  for (int i = 1; i < 24; ++i) {
    const std::string next = "\"part" + std::to_string(i + 1) + ".toml\"";
    folder.write("part" + std::to_string(i) + ".toml", "include = [" + next + ", " + next + "]\n");
  }
  folder.write("part24.toml", "schema = 1\n");
  EXPECT_THAT(refused("include = \"part1.toml\"\n"), HasSubstr("includes more than 256 files"));
}

}  // namespace
}  // namespace gracilis
