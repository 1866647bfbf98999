#include "preparing.hpp"

#include "arrays.hpp"
#include "errors.hpp"
#include "released.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/scene/settings.hpp>
#ifdef GRACILIS_WITH_PREPARE
#include <gracilis/prepare/prepare_surfaces.hpp>
#endif

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace py = pybind11;

namespace gracilis::python {

namespace {

std::vector<NamedSurface> surfaces_of(const py::dict& given) {
  std::vector<NamedSurface> surfaces;
  for (const auto& [key, surface] : given) {
    const std::string name = py::str(key).cast<std::string>();
    surfaces.push_back({name, mesh_from(surface, "surface of '" + name + "'")});
  }
  return surfaces;
}

/// None where no setting can be of that kind. A Python bool is an int, too.
std::optional<SettingValue> setting_value(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
  if (py::isinstance<py::int_>(value)) return value.cast<int>();
  if (py::isinstance<py::float_>(value)) return value.cast<Real>();
  return {};
}

PrepareSettings settings_from(const py::kwargs& keywords) {
  PrepareSettings settings;
  for (const auto& [key, value] : keywords) {
    const std::string name = py::str(key).cast<std::string>();
    const Setting<PrepareSettings>* setting = find_setting<PrepareSettings>(name);
    if (!setting) throw ConfigurationError({"", "", "there is no setting '" + name + "' of prepare", ""});
    const std::optional<SettingValue> given = setting_value(value);
    const std::string problem = given ? assign(settings, *setting, *given) : "must be " + expectation(*setting);
    if (!problem.empty()) throw ConfigurationError({"", "", "'" + name + "' " + problem, ""});
  }
  return settings;
}

py::dict prepare(const py::dict& muscles, const py::dict& bones, const py::kwargs& keywords) {
  const std::vector<NamedSurface> given = surfaces_of(muscles), around = surfaces_of(bones);
  const PrepareSettings settings = settings_from(keywords);
#ifdef GRACILIS_WITH_PREPARE
  const auto prepared = std::make_shared<const PreparedSurfaces>(
      released([&] { return prepare_surfaces(given, around, settings, [](const std::string&) {}); }));
  const py::capsule owner = keeper(prepared);
  py::dict result;
  for (std::size_t i = 0; i < given.size(); ++i)
    result[py::str(given[i].name)] =
        py::make_tuple(rows_view(prepared->muscles[i].vertices, owner), rows_view(prepared->muscles[i].faces, owner));
  return result;
#else
  throw Error(ExitCode::usage, "this package is built without 'prepare': install libcgal-dev and build it again");
#endif
}

}  // namespace

void bind_preparing(py::module_& module) {
  module.def("prepare", &prepare, py::arg("muscles"), py::arg("bones") = py::dict(),
             R"(Surfaces of muscles repaired, remeshed and pulled apart from each other and from bones, which stay.

muscles, bones: name -> (vertices, faces), float64 (n, 3) in m and integers (m, 3). Keywords are the keys of [prepare] in a
scene file, as edge_length=0.004 (m). Returns the muscles in the same form.)");
}

}  // namespace gracilis::python
