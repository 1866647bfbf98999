#include <gracilis/scene/presets.hpp>
#include <gracilis/scene/setting_table.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

namespace gracilis {
namespace {

template <class Settings>
void every_entry_is_complete() {
  std::set<std::string_view> keys;
  Settings settings;
  ASSERT_FALSE(setting_table<Settings>().empty());
  for (const Setting<Settings>& setting : setting_table<Settings>()) {
    EXPECT_TRUE(keys.insert(setting.key).second) << setting.key << " stands twice";
    EXPECT_TRUE(setting.meaning.ends_with('.')) << setting.key;
    EXPECT_EQ(assign(settings, setting, value_of(settings, setting)), "") << "the default of " << setting.key;
  }
}

/// Stands for a value of any type.
struct Any {
  template <class T>
  operator T() const;
};

/// How many members an aggregate has: as many as it accepts initializers.
template <class Aggregate, class... Initializers>
constexpr std::size_t member_count() {
  if constexpr (requires { Aggregate{Initializers{}..., Any{}}; }) {
    return member_count<Aggregate, Initializers..., Any>();
  } else {
    return sizeof...(Initializers);
  }
}

std::string assign_text(XpbdSettings& settings, std::string_view key, SettingValue value) {
  return assign(settings, *find_setting<XpbdSettings>(key), value);
}

}  // namespace

TEST(SettingTable, every_entry_has_a_key_of_its_own_a_meaning_and_a_default_within_its_range) {
  every_entry_is_complete<XpbdSettings>();
  every_entry_is_complete<DistanceFieldSettings>();
  every_entry_is_complete<Sequence>();
  every_entry_is_complete<ContactSettings>();
}

TEST(SettingTable, no_member_of_the_structs_is_forgotten) {
  EXPECT_EQ(setting_table<XpbdSettings>().size(), member_count<XpbdSettings>());
  EXPECT_EQ(setting_table<DistanceFieldSettings>().size(), member_count<DistanceFieldSettings>());
  EXPECT_EQ(setting_table<Sequence>().size(), member_count<Sequence>());
  EXPECT_EQ(setting_table<ContactSettings>().size(), member_count<ContactSettings>());
}

TEST(SettingTable, a_value_of_the_right_kind_within_its_range_is_assigned) {
  XpbdSettings settings;
  EXPECT_EQ(assign_text(settings, "iterations", 70), "");
  EXPECT_EQ(assign_text(settings, "density", 1000), "") << "an integer serves as a number";
  EXPECT_EQ(assign_text(settings, "time_mode", "dynamic"), "");
  EXPECT_EQ(assign_text(settings, "gravity", Vec3(0, 0, -9.81)), "");
  EXPECT_EQ(assign_text(settings, "predictor", false), "");
  EXPECT_EQ(settings.iterations, 70);
  EXPECT_EQ(settings.density, 1000);
  EXPECT_EQ(settings.time_mode, TimeMode::dynamic);
  EXPECT_EQ(settings.gravity.z(), -9.81);
  EXPECT_FALSE(settings.predictor);
}

TEST(SettingTable, a_wrong_kind_or_a_value_out_of_range_is_refused_with_what_it_must_be_and_changes_nothing) {
  XpbdSettings settings;
  EXPECT_EQ(assign_text(settings, "iterations", 0), "must be an integer from 1 to 100000");
  EXPECT_EQ(assign_text(settings, "iterations", 2.5), "must be an integer from 1 to 100000");
  EXPECT_EQ(assign_text(settings, "bone_margin", 0.3), "must be a number from 0 to 0.1 m");
  EXPECT_EQ(assign_text(settings, "bone_margin", std::nan("")), "must be a number from 0 to 0.1 m");
  EXPECT_EQ(assign_text(settings, "time_mode", "static"), "must be one of 'quasi_static', 'dynamic'");
  EXPECT_EQ(assign_text(settings, "predictor", 1), "must be true or false");
  EXPECT_EQ(assign_text(settings, "gravity", 9.81), "must be three numbers from -1000 to 1000 m/s²");
  EXPECT_EQ(list_settings(settings), list_settings(XpbdSettings{}));
}

TEST(SettingTable, numbers_are_written_so_that_every_bit_reads_back) {
  EXPECT_EQ(to_text(SettingValue(1.0 / 60)), "0.016666666666666666");
  EXPECT_EQ(std::strtod(to_text(1.0 / 3).c_str(), nullptr), 1.0 / 3);
  EXPECT_EQ(to_text(SettingValue(2000.0)), "2000.0");
  EXPECT_EQ(to_text(SettingValue(1e30)), "1e+30");
  EXPECT_EQ(to_text(SettingValue(true)), "true");
  EXPECT_EQ(to_text(SettingValue(std::string("atan2"))), "\"atan2\"");
  EXPECT_EQ(to_text(SettingValue(Vec3(0, -9.81, 2))), "[0.0, -9.81, 2.0]");
}

TEST(Presets, the_default_preset_is_the_initializers_of_the_structs) {
  EXPECT_EQ(presets().front().name, "physical");
  EXPECT_EQ(list_settings(presets().front().xpbd), list_settings(XpbdSettings{}));
}

TEST(Presets, the_published_preset_switches_off_what_this_project_added) {
  const Preset* preset = find_preset("thesis-2024");
  ASSERT_NE(preset, nullptr);
  EXPECT_EQ(preset->xpbd.iterations, 70);
  EXPECT_EQ(preset->xpbd.constraint_time_step, 1);
  EXPECT_EQ(preset->xpbd.dihedral_stiffness, 1e8);
  EXPECT_TRUE(preset->xpbd.unit_masses);
  EXPECT_FALSE(preset->xpbd.predictor || preset->xpbd.edge_contact || preset->xpbd.slack_uptake);
  EXPECT_EQ(preset->xpbd.hinge_limit, 0);
  EXPECT_EQ(preset->distance_fields.resolution, 128);
  EXPECT_EQ(preset->contact.muscle, MuscleContact::virtual_edges);
  EXPECT_EQ(preset->contact.contact_distance, 0.002);
  EXPECT_EQ(preset->contact.seed_reach, 0.02);
  EXPECT_EQ(preset->contact.update_period, 5);
  EXPECT_FALSE(preset->contraction.spread);
}

TEST(Presets, every_preset_lies_within_the_ranges_of_the_table) {
  for (const Preset& preset : presets()) {
    XpbdSettings copy;
    for (const auto& setting : setting_table<XpbdSettings>()) {
      EXPECT_EQ(assign(copy, setting, value_of(preset.xpbd, setting)), "") << preset.name << " " << setting.key;
    }
  }
}

TEST(Presets, an_unknown_preset_is_null) { EXPECT_EQ(find_preset("faster"), nullptr); }

}  // namespace gracilis
