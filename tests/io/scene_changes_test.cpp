#include <gracilis/core/errors.hpp>
#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/io/scene/scene_changes.hpp>
#include <gracilis/methods/registry.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {

namespace {

/// The built-in hip, whose muscles have settings of their own for its method.
LoadedScene hip() {
  static const Scene built = demo_scene("hip");
  LoadedScene loaded;
  loaded.scene = built;
  loaded.preset = presets().front().name;
  return loaded;
}

bool has_own_settings(const Scene& scene) {
  return std::any_of(scene.muscles.begin(), scene.muscles.end(),
                     [](const Muscle& muscle) { return !muscle.settings.empty(); });
}

}  // namespace

TEST(SceneChanges, what_was_made_for_another_method_goes_with_it) {
  LoadedScene loaded = hip();
  ASSERT_TRUE(has_own_settings(loaded.scene));
  loaded.scene.method.settings["bone_margin"] = 0.002;
  change_scene(loaded, {"method=pbd", "iterations=5"}, {});
  EXPECT_EQ(loaded.scene.method.name, "pbd");
  EXPECT_EQ(loaded.scene.method.settings, (SettingValues{{"iterations", 5}}));
  EXPECT_FALSE(has_own_settings(loaded.scene)) << "iterations of xpbd are none of pbd";
}

TEST(SceneChanges, naming_the_method_that_a_scene_has_changes_nothing) {
  LoadedScene loaded = hip();
  change_scene(loaded, {"method=xpbd"}, {});
  EXPECT_TRUE(has_own_settings(loaded.scene));
}

TEST(SceneChanges, a_preset_brings_its_method_unless_one_is_named) {
  LoadedScene loaded = hip();
  change_scene(loaded, {"preset=pbd-2020"}, {});
  EXPECT_EQ(loaded.scene.method.name, "pbd");
  EXPECT_EQ(loaded.scene.method.settings, find_preset("pbd-2020")->method.settings);
  EXPECT_EQ(loaded.preset, "pbd-2020");
  LoadedScene named = hip();
  change_scene(named, {"method=arap", "preset=pbd-2020"}, {});
  EXPECT_EQ(named.scene.method.name, "arap");
  EXPECT_TRUE(named.scene.method.settings.empty()) << "settings of the preset are none of arap's";
}

TEST(SceneChanges, an_unknown_preset_or_method_is_named) {
  LoadedScene loaded = hip();
  try {
    change_scene(loaded, {"preset=pbd-2021", "method=pbx"}, {});
    FAIL() << "no error";
  } catch (const ConfigurationError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("there is no preset 'pbd-2021'"));
    EXPECT_THAT(error.what(), testing::HasSubstr("there is no method 'pbx'"));
  }
}

TEST(SceneChanges, that_ask_for_more_memory_than_there_is_are_refused) {
  const auto refused = [](const std::vector<std::string>& set) -> std::string {
    LoadedScene loaded = hip();
    try {
      change_scene(loaded, set, {});
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(refused({"fibers.count=10001"}), testing::HasSubstr("'count' asks for 10001 fibers"));
  EXPECT_THAT(refused({"distance_field.cell_size=1e-5"}), testing::HasSubstr("'cell_size' asks for grids of"));
}

TEST(SceneChanges, fields_for_strings_are_estimated_too) {
  LoadedScene loaded = hip();
  // A hip of tens of meters, as of wrong units; coarse cells are right for the fields that the scene describes itself.
  for (Bone& bone : loaded.scene.bones) bone.surface.vertices *= 100;
  try {
    change_scene(loaded, {"method=strings", "distance_field.resolution=64"}, {});
    FAIL() << "no error";
  } catch (const ConfigurationError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("pulling fibers tight asks for grids of"));
  }
}

}  // namespace gracilis
