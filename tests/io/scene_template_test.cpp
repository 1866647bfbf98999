#include <gracilis/io/scene/scene_template.hpp>

#include <gracilis/anatomy/attachments/attachments.hpp>
#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/io/scene/data_root.hpp>
#include <gracilis/io/scene/scene_description.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/methods/xpbd/settings.hpp>
#include <gracilis/scene/setting_table.hpp>

#include "io/scene_reader_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

namespace gracilis {
namespace {

using testing::HasSubstr;

}  // namespace

TEST_F(SceneReader, the_template_reads_back_with_every_setting_at_its_default) {
  const SceneDescription description = read_scene_description(folder.write("template.toml", scene_template()), {}, {});
  const Scene& scene = description.scene;
  EXPECT_EQ(list_settings(with_values(XpbdSettings{}, scene.method.settings)), list_settings(XpbdSettings{}));
  EXPECT_EQ(list_settings(with_values(ContactSettings{}, scene.method.contact)), list_settings(ContactSettings{}));
  EXPECT_EQ(list_settings(scene.distance_fields), list_settings(DistanceFieldSettings{}));
  EXPECT_EQ(list_settings(scene.sequence), list_settings(Sequence{}));
  EXPECT_EQ(description.muscles.at(0).attachments.size(), 4u);
}

TEST_F(SceneReader, the_template_gives_unit_range_and_default_of_every_setting) {
  for (const auto& setting : setting_table<XpbdSettings>()) {
    EXPECT_THAT(scene_template(), HasSubstr("# " + std::string(setting.meaning) + "\n# " + expectation(setting) + "\n" +
                                            std::string(setting.key) + " = "));
  }
}

TEST(Scenes, the_scenes_of_the_cadaver_hip_are_sound) {
  const std::filesystem::path scenes = std::filesystem::path(GRACILIS_SOURCE_DIR) / "scenes" / "lhdl_hip";
  if (!std::filesystem::exists(find_data_root(scenes / "hip.toml", {}) / "lhdl-hip")) {
    GTEST_SKIP() << "the cadaver's data is not there";
  }
  const std::map<std::string, std::size_t> frames = {{"flexion", 193},     {"extension", 37},
                                                     {"abduction", 52},    {"rotation", 67},
                                                     {"flexion_120", 127}, {"flexion_thesis_2024", 193},
                                                     {"flexion_60", 67}};
  for (const auto& [name, count] : frames) {
    SCOPED_TRACE(name);
    const LoadedScene loaded = read_scene(scenes / (name + ".toml"));
    EXPECT_EQ(pose_sequence(loaded.scene).size(), count);
    EXPECT_EQ(loaded.scene.muscles.size(), name == "flexion_120" ? 1u : 5u);
    for (const Muscle& muscle : loaded.scene.muscles) {
      for (const Attachment& attachment : muscle.attachments) {
        const AttachmentArea area = attachment_area(muscle.surface, attachment.vertices);
        EXPECT_GE(area.area, 150e-6) << muscle.name << " " << attachment.name;
        EXPECT_FALSE(area.sliver()) << muscle.name << " " << attachment.name;
      }
    }
  }
}

}  // namespace gracilis
