#pragma once

#include <gracilis/core/types.hpp>

#include <array>
#include <concepts>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// What users may set, said once: key, unit, range and meaning of each member of a struct of settings, in a table
/// beside the struct. Scene files, `--set`, `print-config` and the manifest of a run all read these tables. The default
/// is the member's initializer. A choice is an enumeration with a function `choices_of`, which names its values in
/// their order.
namespace gracilis {

/// A setting's value outside its struct; texts, and choices such as a TimeMode, are strings.
using SettingValue = std::variant<bool, int, Real, Vec3, std::string>;

enum class SettingKind { flag, integer, number, vector, text, choice };

/// A setting as those see it who do not know the struct that it belongs to.
struct SettingInfo {
  std::string_view key;
  SettingKind kind = SettingKind::flag;
  std::string_view unit;  ///< empty for numbers without one and for switches
  Real minimum = 0;  ///< both bounds are allowed values; of each component of a vector; unused by switches and choices
  Real maximum = 0;
  std::string_view meaning;                    ///< one sentence
  bool is_shared = false;                      ///< holds for all muscles of a scene: none has one of its own
  std::vector<std::string_view> choices = {};  ///< names of a choice's values
};

/// What a setting may be: "an integer from 1 to 10000", "a number from 0 to 1 m", "true or false", "one of 'a', 'b'".
std::string expectation(const SettingInfo& setting);

/// The value in the setting's own type, an integer as a number where one is asked for; none where the setting may not
/// be that.
std::optional<SettingValue> accepted(const SettingInfo& setting, const SettingValue& value);

/// A value as scene files write it; numbers keep every bit.
std::string to_text(const SettingValue& value);

/// A number as scene files write it: the shortest text that reads back as the same bits.
std::string to_text(Real value);

/// The shortest decimal number that rounds to `value`.
Real shortest_decimal(float value);

/// A member of Settings that users may set.
template <class Settings>
struct Setting : SettingInfo {
  /// A member with the bounds, both allowed, and the meaning that people read; `of_all`: muscles of a scene share it.
  template <class T, class Owner>
  requires std::derived_from<Settings, Owner> Setting(std::string_view name, T Owner::*member, std::string_view in_unit,
                                                      Real least, Real greatest, std::string_view sentence,
                                                      bool of_all = false) {
    SettingInfo::operator=({name, kind_of<T>(), in_unit, least, greatest, sentence, of_all});
    if constexpr (std::is_enum_v<T>) {
      for (const std::string_view choice : choices_of(T{})) choices.push_back(choice);
      get = [member](const Settings& s) { return std::string(choices_of(T{})[static_cast<std::size_t>(s.*member)]); };
      set = [names = choices, member](Settings& s, const SettingValue& value) {
        for (std::size_t i = 0; i < names.size(); ++i)
          if (names[i] == std::get<std::string>(value)) s.*member = static_cast<T>(i);
      };
    } else if constexpr (std::is_same_v<T, float>) {
      get = [member](const Settings& s) { return shortest_decimal(s.*member); };
      set = [member](Settings& s, const SettingValue& v) { s.*member = static_cast<float>(std::get<Real>(v)); };
    } else {
      get = [member](const Settings& s) { return s.*member; };
      set = [member](Settings& s, const SettingValue& value) { s.*member = std::get<T>(value); };
    }
  }

  std::function<SettingValue(const Settings&)> get;
  std::function<void(Settings&, const SettingValue&)> set;  ///< of a value that is `accepted`

 private:
  template <class T>
  static constexpr SettingKind kind_of() {
    if (std::is_enum_v<T>) return SettingKind::choice;
    if (std::is_same_v<T, bool>) return SettingKind::flag;
    if (std::is_same_v<T, int>) return SettingKind::integer;
    if (std::is_floating_point_v<T>) return SettingKind::number;
    return std::is_same_v<T, Vec3> ? SettingKind::vector : SettingKind::text;
  }
};

/// The table of one struct, in the order in which it is shown. Defined for each struct of settings beside it.
template <class Settings>
std::span<const Setting<Settings>> setting_table();  ///< a row for each setting

/// The table's entry with this key, or null.
template <class Settings>
const Setting<Settings>* find_setting(std::string_view key) {
  for (const Setting<Settings>& setting : setting_table<Settings>())
    if (setting.key == key) return &setting;
  return nullptr;
}

/// The value that `settings` holds.
template <class Settings>
SettingValue value_of(const Settings& settings, const Setting<Settings>& setting) {
  return setting.get(settings);
}

/// Puts a value into `settings` and returns "", or leaves it as it is and returns what the value must be, as in "must
/// be a number from 0 to 1". An integer is taken where a number is asked for.
template <class Settings>
std::string assign(Settings& settings, const Setting<Settings>& setting, const SettingValue& value) {
  const std::optional<SettingValue> fit = accepted(setting, value);
  if (!fit) return "must be " + expectation(setting);
  setting.set(settings, *fit);
  return "";
}

/// Every setting with its value, in the table's order: what a run's manifest lists.
template <class Settings>
std::vector<std::pair<std::string, SettingValue>> list_settings(const Settings& settings) {
  std::vector<std::pair<std::string, SettingValue>> list;
  for (const Setting<Settings>& setting : setting_table<Settings>())
    list.emplace_back(setting.key, value_of(settings, setting));
  return list;
}

}  // namespace gracilis
