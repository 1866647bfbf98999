#include <gracilis/scene/contraction_settings.hpp>
#include <gracilis/scene/fiber_settings.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/scene/setting_values.hpp>
#include <gracilis/scene/settings.hpp>

#include <member_count.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

namespace gracilis {

enum class Shade { light, dark };
constexpr std::array<std::string_view, 2> choices_of(Shade) { return {"light", "dark"}; }

struct OfABase {
  int count = 3;
};

/// One member of every kind.
struct Sample : OfABase {
  Real length = 0.5;
  float share = 0.1f;
  bool on = true;
  Vec3 direction = Vec3::Zero();
  std::string name;
  Shade shade = Shade::light;
};

template <>
std::span<const Setting<Sample>> setting_table() {
  using S = Sample;
  static const Setting<S> table[] = {
      {"count", &S::count, "", 1, 100000, "How many."},
      {"length", &S::length, "m", 0, 0.6, "How long."},
      {"share", &S::share, "", 0, 1, "How much."},
      {"on", &S::on, "", 0, 0, "Whether."},
      {"direction", &S::direction, "m/s²", -1000, 1000, "Whither."},
      {"name", &S::name, "", 0, 0, "What."},
      {"shade", &S::shade, "", 0, 0, "How dark."},
  };
  return table;
}

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

std::string assign_text(Sample& settings, std::string_view key, SettingValue value) {
  return assign(settings, *find_setting<Sample>(key), value);
}

}  // namespace

TEST(SettingTable, every_entry_has_a_key_of_its_own_a_meaning_and_a_default_within_its_range) {
  every_entry_is_complete<DistanceFieldSettings>();
  every_entry_is_complete<FiberSettings>();
  every_entry_is_complete<ContractionSettings>();
  every_entry_is_complete<Sequence>();
  every_entry_is_complete<PrepareSettings>();
}

TEST(SettingTable, no_member_of_the_structs_is_forgotten) {
  EXPECT_EQ(setting_table<DistanceFieldSettings>().size(), member_count<DistanceFieldSettings>());
  EXPECT_EQ(setting_table<FiberSettings>().size(), member_count<FiberSettings>());
  EXPECT_EQ(setting_table<ContractionSettings>().size(), member_count<ContractionSettings>());
  EXPECT_EQ(setting_table<Sequence>().size(), member_count<Sequence>());
  EXPECT_EQ(setting_table<PrepareSettings>().size(), member_count<PrepareSettings>());
}

TEST(SettingTable, a_value_of_the_right_kind_within_its_range_is_assigned) {
  Sample settings;
  EXPECT_EQ(assign_text(settings, "count", 70), "");
  EXPECT_EQ(assign_text(settings, "length", 0), "") << "an integer serves as a number";
  EXPECT_EQ(assign_text(settings, "share", 0.7), "");
  EXPECT_EQ(assign_text(settings, "shade", "dark"), "");
  EXPECT_EQ(assign_text(settings, "direction", Vec3(0, 0, -9.81)), "");
  EXPECT_EQ(assign_text(settings, "on", false), "");
  EXPECT_EQ(assign_text(settings, "name", "x"), "");
  EXPECT_EQ(settings.count, 70);
  EXPECT_EQ(settings.length, 0);
  EXPECT_EQ(settings.share, 0.7f);
  EXPECT_EQ(settings.shade, Shade::dark);
  EXPECT_EQ(settings.direction.z(), -9.81);
  EXPECT_FALSE(settings.on);
  EXPECT_EQ(settings.name, "x");
}

TEST(SettingTable, a_wrong_kind_or_a_value_out_of_range_is_refused_with_what_it_must_be_and_changes_nothing) {
  Sample settings;
  EXPECT_EQ(assign_text(settings, "count", 0), "must be an integer from 1 to 100000");
  EXPECT_EQ(assign_text(settings, "count", 2.5), "must be an integer from 1 to 100000");
  EXPECT_EQ(assign_text(settings, "length", 0.7), "must be a number from 0 to 0.6 m");
  EXPECT_EQ(assign_text(settings, "length", std::nan("")), "must be a number from 0 to 0.6 m");
  EXPECT_EQ(assign_text(settings, "shade", "static"), "must be one of 'light', 'dark'");
  EXPECT_EQ(assign_text(settings, "on", 1), "must be true or false");
  EXPECT_EQ(assign_text(settings, "direction", 9.81), "must be three numbers from -1000 to 1000 m/s²");
  EXPECT_EQ(assign_text(settings, "name", 1), "must be a text in quotes");
  EXPECT_EQ(list_settings(settings), list_settings(Sample{}));
}

TEST(SettingTable, single_precision_is_shown_by_its_shortest_number) {
  EXPECT_EQ(value_of(Sample{}, *find_setting<Sample>("share")), SettingValue(0.1));
}

TEST(SettingValues, hold_what_is_not_at_its_default_and_give_it_back) {
  Sample settings;
  settings.count = 5, settings.shade = Shade::dark, settings.share = 0.3f;
  const SettingValues changed = changed_values(settings);
  EXPECT_EQ(changed, (SettingValues{{"count", 5}, {"shade", "dark"}, {"share", 0.3}}));
  EXPECT_EQ(list_settings(with_values(Sample{}, changed)), list_settings(settings));
}

TEST(SettingValues, that_are_not_of_the_struct_or_not_allowed_are_left_out) {
  EXPECT_EQ(list_settings(with_values(Sample{}, {{"count", 0}, {"else", 1}})), list_settings(Sample{}));
}

TEST(SettingValues, a_description_has_the_defaults) {
  const std::vector<DescribedSetting> table = describe_settings<Sample>();
  ASSERT_EQ(table.size(), 7u);
  EXPECT_EQ(table[1].default_value, SettingValue(0.5));
  EXPECT_EQ(expectation(table[1]), "a number from 0 to 0.6 m");
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

}  // namespace gracilis
