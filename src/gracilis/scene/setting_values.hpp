#pragma once

#include <gracilis/scene/setting_table.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace gracilis {

/// Settings by their keys, for those who pass them on and do not know what they mean.
using SettingValues = std::map<std::string, SettingValue, std::less<>>;

/// A setting with its default.
struct DescribedSetting : SettingInfo {
  SettingValue default_value;
};

/// The table of a struct for those who do not know it.
template <class Settings>
std::vector<DescribedSetting> describe_settings() {
  std::vector<DescribedSetting> described;
  const Settings defaults;
  for (const Setting<Settings>& setting : setting_table<Settings>())
    described.push_back({setting, value_of(defaults, setting)});
  return described;
}

/// The settings with these values in the place of their own; what is not of the struct, or not allowed, is left out.
template <class Settings>
Settings with_values(Settings settings, const SettingValues& values) {
  for (const Setting<Settings>& setting : setting_table<Settings>())
    if (const auto found = values.find(setting.key); found != values.end()) assign(settings, setting, found->second);
  return settings;
}

/// What of the settings is not as it is by default.
template <class Settings>
SettingValues changed_values(const Settings& settings) {
  SettingValues changed;
  const Settings defaults;
  for (const Setting<Settings>& setting : setting_table<Settings>())
    if (const SettingValue value = value_of(settings, setting); value != value_of(defaults, setting))
      changed.emplace(setting.key, value);
  return changed;
}

}  // namespace gracilis
