#include "opensim_models.hpp"

#include "errors.hpp"
#include "released.hpp"
#include "tables.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/opensim/import/scene_folder.hpp>
#include <gracilis/opensim/kinematics/loop_closer.hpp>
#include <gracilis/opensim/kinematics/low_pass.hpp>
#include <gracilis/opensim/paths/path_tables.hpp>
#include <gracilis/opensim/reader/model_notes.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>
#include <gracilis/opensim/static_optimization/optimization_notes.hpp>
#include <gracilis/scene/names.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include <filesystem>
#include <numeric>
#include <set>

namespace py = pybind11;

namespace gracilis::python {

namespace {

namespace fs = std::filesystem;

/// What could be survived, to be told once the interpreter's lock is held again.
using Notes = std::vector<std::string>;

void warn_of(const Notes& notes) {
  const py::object kind = py::module_::import("gracilis.errors").attr("SceneWarning");
  for (const std::string& note : notes)
    if (PyErr_WarnEx(kind.ptr(), note.c_str(), 1) != 0) throw py::error_already_set();
}

void add(const Notes& more, Notes& notes) { notes.insert(notes.end(), more.begin(), more.end()); }

opensim::Model closed_model(const fs::path& path, Notes& notes) {
  opensim::Model model = opensim::read_model(path);
  add(opensim::approximate_path_notes(model), notes);
  add(opensim::unsupported_notes(model), notes);
  const opensim::LoopClosure closure = opensim::assemble_defaults(model);
  if (const std::string note = opensim::open_loops_note(model, closure); !note.empty()) notes.push_back(note);
  return model;
}

/// A motion's file, or its columns.
struct GivenMotion {
  fs::path file;
  Table table;
};

GivenMotion given_motion(const py::object& motion) {
  if (py::isinstance<py::dict>(motion)) {
    const bool in_degrees = py::getattr(motion, "in_degrees", py::bool_(false)).cast<bool>();
    GivenMotion given{{}, as_table(py::reinterpret_borrow<py::dict>(motion), "motion", in_degrees)};
    if (given.table.times.empty()) refuse("motion", "has no rows");
    return given;
  }
  return {motion.cast<fs::path>(), {}};
}

opensim::CoordinateMotion motion_of(const opensim::Model& model, const GivenMotion& given, Notes& notes) {
  const Table table = given.file.empty() ? given.table : read_table(given.file);
  opensim::CoordinateMotion motion = opensim::coordinate_motion(model, table);
  add(table.warnings, notes);
  add(motion.notes, notes);
  return motion;
}

std::vector<fs::path> import_model(const fs::path& path, const fs::path& out, const std::vector<fs::path>& geometry,
                                   const std::vector<fs::path>& motions, const std::vector<std::string>& muscles,
                                   bool apart, bool merge_heads) {
  Notes notes;
  std::vector<fs::path> scenes;
  released([&] {
    const opensim::Model model = closed_model(path, notes);
    if (fs::exists(out / "model.toml"))
      throw ConfigurationError({out.string(), "", "holds a model already", "name another folder, or remove this one"});
    std::vector<opensim::NamedMotion> named;
    std::set<std::string> names = {"model"};
    for (const fs::path& file : motions)
      named.push_back({file_name_of(file.stem().string(), names), motion_of(model, {file, {}}, notes)});
    if (named.empty()) named.push_back({"rest", {{0}, opensim::default_coordinates(model).transpose(), {}}});
    opensim::SceneFolderSettings settings;
    settings.muscles = muscles;
    settings.apart = apart;
    settings.merge_heads = merge_heads;
    const opensim::SceneFolderNotes written =
        opensim::write_scene_folder(model, {path.parent_path(), geometry, {}}, named, settings, out);
    add(written.left_out, notes);
    for (const opensim::NamedMotion& motion : named)
      scenes.push_back(out / (opensim::motion_file_name(motion) + ".toml"));
  });
  warn_of(notes);
  return scenes;
}

py::tuple paths(const fs::path& path, const py::object& motion) {
  const GivenMotion given = given_motion(motion);
  Notes notes;
  const opensim::PathTables tables = released([&] {
    const opensim::Model model = closed_model(path, notes);
    if (model.muscles.empty()) throw InputError({path.string(), "", "has no muscles", "name another model"});
    return opensim::path_tables(model, motion_of(model, given, notes));
  });
  for (const opensim::LengthsApart& each : opensim::lengths_apart(tables))
    notes.push_back(
        fmt::format("{}: lengths are those of the way around its wraps, of which the moment arms are, up to "
                    "{:.1f} mm off what OpenSim computes",
                    each.muscle, 1000 * each.most));
  warn_of(notes);
  py::dict arms;
  for (const auto& [coordinate, table] : tables.moment_arms) arms[py::str(coordinate)] = as_python(table);
  return py::make_tuple(as_python(tables.way_lengths), arms);
}

/// Tells Python's function how far it is; what that raises ends the work.
std::function<void(std::size_t)> told(const py::object& progress, const std::size_t& all) {
  return [&](std::size_t done) {
    throw_if_stopped();
    if (progress.is_none()) return;
    const py::gil_scoped_acquire lock;
    progress(done, all);
  };
}

py::tuple static_optimization(const fs::path& path, const py::object& motion, const fs::path& loads,
                              const std::vector<fs::path>& forces, bool replace, Real exponent, Real cutoff,
                              const py::object& progress) {
  if (!(exponent > 1)) refuse("exponent", "must be larger than 1");
  const GivenMotion given = given_motion(motion);
  Notes notes;
  std::size_t all = 0;
  const opensim::StaticOptimizationResult result = released([&] {
    opensim::Model model = closed_model(path, notes);
    bool first = replace;
    for (const fs::path& file : forces) {
      const std::size_t known = model.unsupported.size();
      opensim::read_force_set(file, first, model);
      add(opensim::unsupported_notes(model, known), notes);
      first = false;
    }
    opensim::CoordinateMotion moved = motion_of(model, given, notes);
    if (cutoff > 0) moved.values = opensim::low_pass(moved.times, moved.values, cutoff);
    opensim::ExternalLoads external;
    if (!loads.empty()) external = opensim::read_external_loads(model, loads);
    const std::string unmeasured = opensim::unmeasured_loads_note(external, moved.times.front(), moved.times.back());
    if (!unmeasured.empty()) notes.push_back(loads.string() + ": " + unmeasured);
    std::vector<std::size_t> rows(moved.times.size());
    std::iota(rows.begin(), rows.end(), 0);
    all = rows.size();
    opensim::StaticOptimizationSettings settings;
    settings.exponent = exponent;
    opensim::StaticOptimizationResult found =
        opensim::static_optimization(model, moved, external, rows, settings, told(progress, all));
    add(opensim::weakness_notes(found), notes);
    if (const std::string note = opensim::missing_forces_note(model); !note.empty()) notes.push_back(note);
    return found;
  });
  warn_of(notes);
  return py::make_tuple(as_python(result.activations), as_python(result.forces));
}

}  // namespace

void bind_opensim(py::module_& module) {
  module.def("import_model", &import_model, py::arg("model"), py::arg("out"), py::kw_only(),
             py::arg("geometry") = std::vector<fs::path>{}, py::arg("motions") = std::vector<fs::path>{},
             py::arg("muscles") = std::vector<std::string>{}, py::arg("apart") = false, py::arg("merge_heads") = false,
             R"(Makes a folder with a scene of bones, joints and volumetric muscles of an OpenSim model (.osim).

geometry: folders of the bones' surfaces. motions: files (.mot, .sto) to make a scene for. muscles: names to take (all).
apart: muscles keep out of each other. merge_heads: heads of one muscle become one sheet. Returns the scene files, for
load(). What was left out is a SceneWarning.)");
  module.def("paths", &paths, py::arg("model"), py::arg("motion"),
             R"(Lengths and moment arms of an OpenSim model's muscles through a motion.

motion: a file, or a dict of (rows,) arrays by coordinates' names with "time" (s), in rad and m unless it is a Table with
in_degrees. Returns (lengths, arms): a Table of m, and coordinate -> Table of m; a column per muscle.)");
  module.def("static_optimization", &static_optimization, py::arg("model"), py::arg("motion"), py::kw_only(),
             py::arg("loads") = "", py::arg("forces") = std::vector<fs::path>{}, py::arg("replace") = false,
             py::arg("exponent") = 2.0, py::arg("cutoff") = 0.0, py::arg("progress") = py::none(),
             R"(Activations of an OpenSim model's muscles that give a motion at the least cost.

motion: as of paths(). loads: external loads (.xml). forces: force sets with more actuators (.xml); replace: the model's
own forces are taken away first. cutoff: Hz, of a low-pass filter of the motion; 0: none. progress: called with (rows done, all rows).
Returns (activations, forces): Tables with a column per muscle and actuator, 0 to 1 and N (N·m).)");
}

}  // namespace gracilis::python
