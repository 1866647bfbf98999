#include <gracilis/io/scene/method_reader.hpp>

#include <gracilis/io/suggestions.hpp>
#include <gracilis/methods/registry.hpp>

#include <string_view>

namespace gracilis {

const MethodEntry& read_method(TomlReader& top, MethodChoice& choice) {
  const MethodEntry& usual = methods().front();
  choice.name = top.text("method").value_or(choice.name);
  if (const MethodEntry* method = find_method(choice.name)) return *method;
  std::vector<std::string> names;
  for (const MethodEntry& method : methods()) names.emplace_back(method.name);
  top.add_problem("method", "there is no method '" + choice.name + "'", suggestion(choice.name, names));
  return usual;
}

std::optional<Preset> named_preset(TomlReader& top, const std::string& name) {
  std::optional<Preset> preset = find_preset(name);
  if (preset) return preset;
  std::vector<std::string> names;
  for (const Preset& each : presets()) names.emplace_back(each.name);
  top.add_problem("preset", "there is no preset '" + name + "'", suggestion(name, names));
  return std::nullopt;
}

void read_method_settings(TomlReader& table, const MethodEntry& method,
                          std::vector<DescribedSetting> MethodEntry::*which, SettingValues& values,
                          std::set<std::string>& others) {
  std::set<std::string_view> read;
  for (const DescribedSetting& each : method.*which) {
    if (const std::optional<SettingValue> value = table.setting(each)) values[std::string(each.key)] = *value;
    read.insert(each.key);
  }
  for (const MethodEntry& other : methods())
    for (const DescribedSetting& each : other.*which)
      if (read.insert(each.key).second && table.setting(each)) others.insert(std::string(each.key));
}

std::string note_on_others(const std::string& method, const std::set<std::string>& keys) {
  if (keys.empty()) return {};
  std::string list;
  for (const std::string& key : keys) list += (list.empty() ? "'" : ", '") + key + "'";
  return "the method '" + method + "' has no setting " + list + ", which changes nothing";
}

}  // namespace gracilis
