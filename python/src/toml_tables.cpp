#include "toml_tables.hpp"

#include "arrays.hpp"
#include "errors.hpp"

#include <gracilis/methods/registry.hpp>

#include <algorithm>
#include <sstream>
#include <variant>

namespace py = pybind11;

namespace gracilis::python {

namespace {

std::string text_of(const py::handle& object) { return py::str(object).cast<std::string>(); }

/// What a scene file may hold.
using Value = std::variant<bool, std::int64_t, double, std::string, toml::array, toml::table>;

Value value_of(const py::handle& object, const std::string& where, SceneTables& scene);

toml::table table_of(const py::dict& dict, const std::string& where, SceneTables& scene) {
  toml::table table;
  for (const auto& [key, object] : dict) {
    if (object.is_none()) continue;
    const std::string name = text_of(key), path = where.empty() ? name : where + "." + name;
    if (name == "surface") {
      const std::string owner = dict.contains("name") ? text_of(dict["name"]) : where;
      table.insert("given", static_cast<std::int64_t>(scene.surfaces.size()));
      scene.surfaces.push_back(mesh_from(object, "surface of '" + owner + "'"));
      continue;
    }
    std::visit([&](auto&& value) { table.insert(name, std::move(value)); }, value_of(object, path, scene));
  }
  return table;
}

toml::array array_of(const py::sequence& sequence, const std::string& where, SceneTables& scene) {
  toml::array array;
  for (const py::handle& each : sequence)
    std::visit([&](auto&& value) { array.push_back(std::move(value)); }, value_of(each, where, scene));
  return array;
}

Value value_of(const py::handle& object, const std::string& where, SceneTables& scene) {
  if (py::isinstance<py::dict>(object)) return table_of(py::reinterpret_borrow<py::dict>(object), where, scene);
  if (py::isinstance<py::bool_>(object)) return object.cast<bool>();
  if (py::isinstance<py::str>(object)) return object.cast<std::string>();
  if (py::hasattr(object, "tolist")) return value_of(object.attr("tolist")(), where, scene);  // NumPy's
  if (py::isinstance<py::int_>(object)) return object.cast<std::int64_t>();
  if (py::isinstance<py::float_>(object)) return object.cast<double>();
  if (py::hasattr(object, "__fspath__")) return text_of(object);
  if (py::isinstance<py::sequence>(object)) return array_of(py::reinterpret_borrow<py::sequence>(object), where, scene);
  refuse(where, "is a " + text_of(py::type::handle_of(object).attr("__name__")) + ", which no scene file can hold");
}

/// As a scene file writes it.
std::string value_text(const py::handle& object, const std::string& where) {
  SceneTables none;
  std::ostringstream text;
  std::visit(
      [&](auto&& value) {
        using Kind = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Kind, toml::array> || std::is_same_v<Kind, toml::table>)
          text << value;
        else if constexpr (std::is_same_v<Kind, std::int64_t>)
          text << value;
        else
          text << to_text(SettingValue(value));
      },
      value_of(object, where, none));
  return text.str();
}

/// Whether any method has a setting with this key.
bool is_setting(const std::string& key) {
  return std::any_of(methods().begin(), methods().end(), [&](const MethodEntry& method) {
    return std::any_of(method.settings.begin(), method.settings.end(),
                       [&](const DescribedSetting& setting) { return setting.key == key; });
  });
}

/// A table or a list of tables, as [joints] is: never a setting, whatever its key.
bool holds_tables(const py::handle& object) {
  if (py::isinstance<py::dict>(object)) return true;
  if (!py::isinstance<py::list>(object) && !py::isinstance<py::tuple>(object)) return false;
  const py::sequence sequence = py::reinterpret_borrow<py::sequence>(object);
  return py::len(sequence) > 0 && py::isinstance<py::dict>(py::object(sequence[0]));
}

}  // namespace

std::vector<std::string> settings_of(const py::dict& keywords) {
  std::vector<std::string> set;
  for (const auto& [key, value] : keywords) {
    const std::string name = text_of(key);
    if (!py::isinstance<py::dict>(value)) {
      set.push_back(name + "=" + value_text(value, name));
      continue;
    }
    for (const auto& [inner, each] : py::reinterpret_borrow<py::dict>(value))
      set.push_back(name + "." + text_of(inner) + "=" + value_text(each, name + "." + text_of(inner)));
  }
  return set;
}

SceneTables scene_tables(const py::dict& keywords) {
  py::dict top, settings;
  for (const auto& [key, value] : keywords)
    (is_setting(text_of(key)) && !holds_tables(value) ? settings : top)[key] = value;
  if (!settings.empty()) {
    if (top.contains("settings")) settings.attr("update")(top["settings"]);
    top["settings"] = settings;
  }
  if (!top.contains("schema")) top["schema"] = 1;
  SceneTables scene;
  scene.tables = table_of(top, "", scene);
  return scene;
}

}  // namespace gracilis::python
