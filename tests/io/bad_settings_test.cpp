#include <gracilis/methods/registry.hpp>

#include "io/scene_reader_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

/// Every setting of every registered method, with what it may not be.
namespace gracilis {

namespace {

/// Values of the wrong kind, and those beyond its bounds.
std::vector<std::string> bad_values(const SettingInfo& setting) {
  const std::string below = to_text(setting.minimum - 1), above = to_text(setting.maximum + 1 + setting.maximum / 100);
  switch (setting.kind) {
    case SettingKind::flag:
      return {"\"yes\"", "1"};
    case SettingKind::integer: {
      const auto whole = [](Real value) { return std::to_string(static_cast<long>(value)); };
      return {"\"many\"", "0.5", whole(setting.minimum - 1), whole(setting.maximum + 1)};
    }
    case SettingKind::number:
      return {"\"much\"", "true", below, above, "nan", "inf"};
    case SettingKind::vector:
      return {"1.0", "[1.0, 2.0]", "[0.0, 0.0, " + above + "]"};
    case SettingKind::text:
      return {"7", "true"};
    case SettingKind::choice:
      return {"\"neither\"", "7"};
  }
  return {};
}

}  // namespace

TEST_F(SceneReader, a_bad_value_of_any_methods_setting_is_named_with_what_it_may_be) {
  int asked = 0;
  for (const MethodEntry& method : methods()) {
    const auto ask = [&](const std::string& section, const DescribedSetting& setting) {
      for (const std::string& value : bad_values(setting)) {
        std::string scene = good_scene();
        scene.insert(scene.find("[["), "method = \"" + std::string(method.name) + "\"\n");
        const std::string key(setting.key);
        EXPECT_THAT(problems(scene + section + "\n" + key + " = " + value + "\n"),
                    testing::HasSubstr("'" + key + "' must be " + expectation(setting)))
            << method.name << ": " << key << " = " << value;
        EXPECT_EQ(code, ExitCode::usage);
        ++asked;
      }
    };
    for (const DescribedSetting& setting : method.settings) ask("[settings]", setting);
    for (const DescribedSetting& setting : method.contact) ask("[contact]", setting);
  }
  EXPECT_GT(asked, 300);
}

}  // namespace gracilis
