#include "scene_handle.hpp"

#include "arrays.hpp"
#include "errors.hpp"
#include "released.hpp"
#include "toml_tables.hpp"

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/io/scene/given_scene.hpp>
#include <gracilis/io/scene/scene_changes.hpp>
#include <gracilis/io/scene/scene_template.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/simulate/run.hpp>
#ifdef GRACILIS_WITH_PREPARE
#include <gracilis/prepare/prepare_surfaces.hpp>
#endif

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include <filesystem>

namespace py = pybind11;

namespace gracilis::python {

namespace {

SceneOptions options_of(const std::filesystem::path& data, const std::vector<std::string>& only,
                        std::vector<std::string> set, const py::dict& settings) {
  for (std::string& each : settings_of(settings)) set.push_back(std::move(each));
  SceneOptions options{data, std::move(set), only};
#ifdef GRACILIS_WITH_PREPARE
  options.prepare = prepare_surfaces;
#endif
  return options;
}

void warn_about(const LoadedScene& loaded) {
  if (loaded.warnings.empty()) return;
  const py::object kind = py::module_::import("gracilis.errors").attr("SceneWarning");
  for (const std::string& warning : loaded.warnings)
    if (PyErr_WarnEx(kind.ptr(), warning.c_str(), 1) != 0) throw py::error_already_set();
}

template <class Make>
SceneHandle scene_by(const Make& make, py::object recipe) {
  SceneHandle scene{std::make_shared<const LoadedScene>(released(make)), std::move(recipe)};
  warn_about(*scene.loaded);
  return scene;
}

template <class... Arguments>
py::object partial(const char* function, const py::dict& keywords, Arguments&&... arguments) {
  return py::module_::import("functools")
      .attr("partial")(py::module_::import("gracilis.recipes").attr(function), std::forward<Arguments>(arguments)...,
                       **keywords);
}

SceneHandle load(const std::filesystem::path& path, const std::filesystem::path& data,
                 const std::vector<std::string>& only, const std::vector<std::string>& set,
                 const py::kwargs& settings) {
  const SceneOptions options = options_of(data, only, set, settings);
  py::dict again = settings.attr("copy")();
  again["data"] = data.string();  // an empty pathlib.Path would be the working folder
  again["only"] = only;
  again["set"] = set;
  return scene_by([&] { return read_scene(path, options); },
                  partial("load", again, py::cast(std::filesystem::absolute(path))));
}

SceneHandle demo(const std::string& name, std::optional<Real> flexion, const std::string& preset,
                 const std::vector<std::string>& only, const std::vector<std::string>& set,
                 const py::kwargs& settings) {
  if (name != "hip" && name != "elbow") refuse("scene", "there is no built-in scene '" + name + "'", "hip or elbow");
  if (flexion && !(*flexion >= 0 && *flexion <= 130)) refuse("flexion", "must be from 0 to 130 degrees");
  std::vector<std::string> names;
  for (const Preset& each : presets()) names.emplace_back(each.name);
  if (!find_preset(preset))
    throw ConfigurationError({"", "preset", "there is no preset '" + preset + "'", suggestion(preset, names)});
  DemoOptions options;
  options.scene = name;
  options.preset = preset;
  options.flexion_deg = flexion;
  const SceneOptions changes = options_of({}, only, set, settings);
  py::dict again = settings.attr("copy")();
  again["flexion"] = flexion;
  again["preset"] = preset;
  again["only"] = only;
  again["set"] = set;
  return scene_by([&] { return load_demo(options, changes); }, partial("demo", again, name));
}

SceneHandle from_arrays(const py::kwargs& keywords) {
  SceneTables given = scene_tables(keywords);
  const SceneOptions options = options_of({}, {}, {}, {});
  return scene_by([&] { return make_scene(given.tables, std::move(given.surfaces), options); },
                  partial("scene", keywords));
}

/// Surfaces in the capture pose by their names, as pairs (vertices, faces).
template <class Part>
py::dict surfaces_of(const SceneHandle& scene, const std::vector<Part>& parts) {
  const py::capsule owner = keeper(scene.loaded);
  py::dict surfaces;
  for (const Part& part : parts)
    surfaces[py::str(part.name)] =
        py::make_tuple(rows_view(part.surface.vertices, owner), rows_view(part.surface.faces, owner));
  return surfaces;
}

std::vector<MotionPose> motion_poses(const SceneHandle& scene) {
  const std::vector<Pose> poses = pose_sequence(scene.loaded->scene, scene.loaded->max_frames);
  std::vector<MotionPose> timed;
  for (std::size_t i = 0; i < poses.size(); ++i)
    timed.push_back({poses[i], i > 0 ? time_before(poses, static_cast<int>(i)) : usual_time_step, scene.loaded});
  return timed;
}

}  // namespace

std::shared_ptr<const LoadedScene> changed(const SceneHandle& scene, const std::string& method,
                                           const py::dict& settings) {
  std::vector<std::string> set = settings_of(settings);
  if (!method.empty()) set.push_back("method=" + method);
  auto copy = std::make_shared<LoadedScene>(*scene.loaded);
  if (set.empty()) return copy;
  copy->warnings.clear();
  change_scene(*copy, set, {});
  warn_about(*copy);
  return copy;
}

py::dict coordinates_by_name(const Scene& scene, const std::vector<Real>& values, bool in_degrees) {
  py::dict named;
  std::size_t number = 0;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes) {
      named[py::str(axis.coordinate)] = in_degrees ? shown_value(axis, values[number]) : values[number];
      ++number;
    }
  return named;
}

void bind_scene(py::module_& module) {
  py::class_<MotionPose>(module, "Pose", "A pose of a scene's own motion.")
      .def_property_readonly(
          "time", [](const MotionPose& self) { return self.pose.time; }, "s")
      .def_readonly("time_step", &MotionPose::time_step, "s after the pose before it")
      .def_property_readonly(
          "coordinates", [](const MotionPose& self) { return copied(self.pose.coordinates); },
          "(c,) float64, rad (m for translations), in the order of Scene.coordinates")
      .def_property_readonly(
          "degrees",
          [](const MotionPose& self) { return coordinates_by_name(self.of->scene, self.pose.coordinates, true); },
          "name -> the coordinate, degrees (mm for translations)")
      .def_property_readonly(
          "activations", [](const MotionPose& self) { return copied(self.pose.activations); },
          "(m,) float64, 0 to 1, in the order of Scene.muscles; empty: all are relaxed");
  py::class_<SceneHandle>(module, "Scene",
                          R"(Bones, joints and muscles in the pose in which they were captured; constant.

Keywords are the keys of a scene file ('gracilis print-config' explains each): name, bones, joints, muscles, motion,
method, ...; tables are dicts, lists of tables lists of dicts. In the place of `file`, a bone or muscle may have
surface=(vertices, faces): float64 (n, 3) in m and int32 (m, 3), counter-clockwise seen from outside. An attachment may
have vertices=, indices into its muscle's. A setting of a method may stand as a keyword of its own, as in iterations=20.)")
      .def(py::init(&from_arrays))
      .def_property_readonly("name", [](const SceneHandle& self) { return self.loaded->scene.name; })
      .def_property_readonly("method", [](const SceneHandle& self) { return self.loaded->scene.method.name; })
      .def_property_readonly("preset", [](const SceneHandle& self) { return self.loaded->preset; })
      .def_property_readonly(
          "warnings", [](const SceneHandle& self) { return self.loaded->warnings; },
          "What a user should know, one line each; also given to warnings.warn.")
      .def_property_readonly(
          "coordinates", [](const SceneHandle& self) { return coordinate_names(self.loaded->scene); },
          "Names of all coordinates of all joints.")
      .def_property_readonly(
          "muscles", [](const SceneHandle& self) { return surfaces_of(self, self.loaded->scene.muscles); },
          "name -> (vertices, faces): read-only views, float64 (n, 3) in m and int32 (m, 3)")
      .def_property_readonly(
          "bones", [](const SceneHandle& self) { return surfaces_of(self, self.loaded->scene.bones); },
          "name -> (vertices, faces), as muscles")
      .def_property_readonly("poses", &motion_poses,
                             "All poses of a run: the capture pose, then one per frame. Simulation.advance takes them.")
      .def(
          "settings_text", [](const SceneHandle& self) { return settings_text(self.loaded->scene); },
          "Every setting as resolved, in the keys of a scene file.")
      .def("__reduce__", [](const SceneHandle& self) { return py::make_tuple(self.recipe, py::tuple()); })
      .def("__repr__", [](const SceneHandle& self) {
        const Scene& scene = self.loaded->scene;
        return fmt::format("<gracilis.Scene '{}': {} bones, {} muscles, method {}>", scene.name, scene.bones.size(),
                           scene.muscles.size(), scene.method.name);
      });
  module.def("load", &load, py::arg("path"), py::kw_only(), py::arg("data") = "",
             py::arg("only") = std::vector<std::string>{}, py::arg("set") = std::vector<std::string>{},
             R"(Reads a scene file (TOML) and all that it names.

data: folder with the scene's files (else GRACILIS_DATA, or shared/data above the scene file).
only: names of the muscles to keep. set: as --set, "key=value". Keywords: the same, as in iterations=20 or
contact={"muscle": "none"}.)");
  module.def("demo", &demo, py::arg("scene") = "hip", py::kw_only(), py::arg("flexion") = py::none(),
             py::arg("preset") = "physical", py::arg("only") = std::vector<std::string>{},
             py::arg("set") = std::vector<std::string>{},
             R"(A built-in scene, 'hip' or 'elbow'; needs no file.

flexion: how far its motion flexes, degrees (hip 90, elbow 130). Other keywords as of load().)");
}

}  // namespace gracilis::python
