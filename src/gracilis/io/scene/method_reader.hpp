#pragma once

#include <gracilis/io/toml_reader.hpp>
#include <gracilis/methods/method_entry.hpp>

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace gracilis {

/// The method that the key `method` names, into `choice`, too; the one that `choice` has already where the key is
/// missing. Where there is none with its name a problem is added, and reading goes on with the default.
const MethodEntry& read_method(TomlReader& top, MethodChoice& choice);

/// The preset with this name; where there is none a problem is added at the key `preset`.
std::optional<Preset> named_preset(TomlReader& top, const std::string& name);

/// Reads the values of one of the tables of a method. Those of other methods are checked, too, and named in `others`: a
/// scene may be run by one method after the other.
void read_method_settings(TomlReader& table, const MethodEntry& method,
                          std::vector<DescribedSetting> MethodEntry::*which, SettingValues& values,
                          std::set<std::string>& others);

/// That settings of other methods change nothing; empty where there are none.
std::string note_on_others(const std::string& method, const std::set<std::string>& keys);

}  // namespace gracilis
