#pragma once

#include <gracilis/scene/contraction_settings.hpp>
#include <gracilis/scene/fiber_settings.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/scene/settings.hpp>

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

/// What users may set, said once: key, unit, range and meaning of each member of XpbdSettings, DistanceFieldSettings,
/// FiberSettings, ContractionSettings, ContactSettings, PrepareSettings and Sequence. Scene files, `--set`,
/// `print-config` and the manifest of a run all read these tables. The default is the member's initializer.
namespace gracilis {

/// A setting's value outside its struct; texts, and choices such as a TimeMode, are strings.
using SettingValue = std::variant<bool, int, Real, Vec3, std::string>;

/// A member of Settings that users may set.
template <class Settings>
struct Setting {
  using Member =
      std::variant<bool Settings::*, int Settings::*, Real Settings::*, Vec3 Settings::*, std::string Settings::*,
                   TimeMode Settings::*, DihedralFormula Settings::*, FiberTemplate Settings::*,
                   MuscleContact Settings::*, TunnellingGuard Settings::*, Skinning Settings::*,
                   VirtualEdgeResolution Settings::*, CoincidingEdges Settings::*, SurfacePaths Settings::*>;
  std::string_view key;
  Member member;
  std::string_view unit;  ///< empty for numbers without one and for switches
  Real minimum = 0;  ///< both bounds are allowed values; of each component of a vector; unused by switches and choices
  Real maximum = 0;
  std::string_view meaning;  ///< one sentence
};

/// The table of one struct, in the order in which it is shown. Defined for the structs named above.
template <class Settings>
std::span<const Setting<Settings>> setting_table();
template <>
std::span<const Setting<XpbdSettings>> setting_table();
template <>
std::span<const Setting<DistanceFieldSettings>> setting_table();
template <>
std::span<const Setting<FiberSettings>> setting_table();
template <>
std::span<const Setting<ContractionSettings>> setting_table();
template <>
std::span<const Setting<Sequence>> setting_table();
template <>
std::span<const Setting<PrepareSettings>> setting_table();
template <>
std::span<const Setting<ContactSettings>> setting_table();

/// The table's entry with this key, or null.
template <class Settings>
const Setting<Settings>* find_setting(std::string_view key) {
  for (const Setting<Settings>& setting : setting_table<Settings>())
    if (setting.key == key) return &setting;
  return nullptr;
}

/// The value that `settings` holds.
template <class Settings>
SettingValue value_of(const Settings& settings, const Setting<Settings>& setting);

/// Puts a value into `settings` and returns "", or leaves it as it is and returns what the value must be, as in "must
/// be a number from 0 to 1". An integer is taken where a number is asked for.
template <class Settings>
std::string assign(Settings& settings, const Setting<Settings>& setting, const SettingValue& value);

/// What a setting may be: "an integer from 1 to 10000", "a number from 0 to 1 m", "true or false", "one of 'a', 'b'".
template <class Settings>
std::string expectation(const Setting<Settings>& setting);

/// A value as scene files write it; numbers keep every bit.
std::string to_text(const SettingValue& value);

/// A number as scene files write it: the shortest text that reads back as the same bits.
std::string to_text(Real value);

/// Every setting with its value, in the table's order: what a run's manifest lists.
template <class Settings>
std::vector<std::pair<std::string, SettingValue>> list_settings(const Settings& settings) {
  std::vector<std::pair<std::string, SettingValue>> list;
  for (const Setting<Settings>& setting : setting_table<Settings>())
    list.emplace_back(setting.key, value_of(settings, setting));
  return list;
}

}  // namespace gracilis
