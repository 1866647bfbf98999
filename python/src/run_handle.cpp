#include "run_handle.hpp"

#include "arrays.hpp"
#include "errors.hpp"
#include "released.hpp"
#include "tables.hpp"

#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/view/report/report.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <variant>

namespace py = pybind11;

namespace gracilis::python {

namespace {

using Run = std::shared_ptr<RecordedRun>;

Run open(const std::filesystem::path& folder) {
  return released([&] { return std::make_shared<RecordedRun>(open_recorded_run(folder)); });
}

/// The frame's number; from the end where it is negative, as Python counts.
int frame_of(const RecordedRun& run, int frame) {
  const int number = frame < 0 ? frame + run.frame_count : frame;
  if (number < 0 || number >= run.frame_count)
    throw py::index_error(fmt::format("there is no frame {}: the run has {}", frame, run.frame_count));
  return number;
}

void require_among(const std::vector<std::string>& names, const std::string& name, const std::string& what) {
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw ConfigurationError({"", "", "the run has no " + what + " '" + name + "'", suggestion(name, names)});
}

py::tuple surface(const Run& self, const std::string& name, int frame) {
  std::vector<std::string> names = self->muscles;
  names.insert(names.end(), self->bones.begin(), self->bones.end());
  require_among(names, name, "surface");
  const int number = frame_of(*self, frame);
  const auto mesh =
      std::make_shared<const TriangleMesh>(released([&] { return recorded_surface(*self, name, number); }));
  const py::capsule owner = keeper(mesh);
  return py::make_tuple(rows_view(mesh->vertices, owner), rows_view(mesh->faces, owner));
}

py::list fibers(const Run& self, const std::string& muscle, int frame) {
  require_among(self->muscles, muscle, "muscle");
  const int number = frame_of(*self, frame);
  const auto lines =
      std::make_shared<const Polylines>(released([&] { return recorded_fibers(*self, muscle, number); }));
  const py::capsule owner = keeper(lines);
  py::list list;
  for (Index i = 0; i < lines->count(); ++i)
    list.append(
        view(lines->points.data() + 3 * static_cast<std::ptrdiff_t>(lines->begin(i)), {lines->size(i), 3}, owner));
  return list;
}

py::dict coordinates(const Run& self) {
  py::dict columns;
  for (std::size_t c = 0; c < self->coordinates.size(); ++c) {
    const Eigen::VectorXd values = self->coordinate_values.col(static_cast<Eigen::Index>(c));
    columns[py::str(self->coordinates[c])] = copied_column(values);
  }
  return columns;
}

py::dict measures(const Run& self) {
  py::dict columns;
  for (std::size_t m = 0; m < self->measures.size(); ++m) columns[py::str(self->measures[m])] = copied(self->values[m]);
  return columns;
}

/// Names of the .sto tables in the folder.
std::vector<std::string> table_names(const RecordedRun& run) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(run.folder))
    if (entry.path().extension() == ".sto") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

py::object table_called(const RecordedRun& self, const std::string& name) {
  require_among(table_names(self), name, "table");
  return as_python(released([&] { return read_table(self.folder / (name + ".sto")); }));
}

/// A run, or the folder of one.
using RunOrFolder = std::variant<Run, std::filesystem::path>;

std::filesystem::path report(const std::vector<RunOrFolder>& runs, const std::filesystem::path& path) {
  if (runs.empty()) refuse("runs", "a report needs a run");
  released([&] {
    std::vector<RecordedRun> shown;
    for (const RunOrFolder& each : runs) {
      const Run* run = std::get_if<Run>(&each);
      if (run && !*run) refuse("runs", "None is no run");
      shown.push_back(run ? **run : open_recorded_run(std::get<std::filesystem::path>(each)));
    }
    write_report(path, shown);
  });
  return path;
}

}  // namespace

void bind_run(py::module_& module) {
  py::class_<RecordedRun, std::shared_ptr<RecordedRun>>(module, "Run", R"(A run folder, as 'gracilis run' writes it.

len(run) is the number of frames; frame 0 is the capture pose. Frames are counted from the end where they are negative.)")
      .def(py::init(&open), py::arg("folder"))
      .def_readonly("folder", &RecordedRun::folder)
      .def_readonly("muscles", &RecordedRun::muscles, "Names, in the scene's order.")
      .def_readonly("bones", &RecordedRun::bones, "Names.")
      .def_readonly("first_motion_frame", &RecordedRun::first_motion_frame,
                    "Frames before it lead from the capture pose to the motion.")
      .def("__len__", [](const RecordedRun& self) { return self.frame_count; })
      .def_property_readonly(
          "times", [](const RecordedRun& self) { return copied(self.times); }, "(frames,) float64, s")
      .def_property_readonly("coordinates", &coordinates,
                             "name with its unit, as hip_flexion_r_deg -> (frames,) float64")
      .def_property_readonly("measures", &measures,
                             "measure -> (frames, muscles) float64, nan where there is none; columns of measures.csv")
      .def_property_readonly(
          "manifest",
          [](const RecordedRun& self) { return py::module_::import("json").attr("loads")(self.manifest.dump()); },
          "run.json")
      .def("surface", &surface, py::arg("name"), py::arg("frame"),
           "(vertices, faces) of a muscle or bone: float64 (n, 3) in m, int32 (m, 3)")
      .def("fibers", &fibers, py::arg("muscle"), py::arg("frame"),
           "List of (k, 3) float64, m, from origin to insertion; empty where the run has none.")
      .def_property_readonly("tables", &table_names, "Names of the tables (.sto) in its folder, as fiber_lengths.")
      .def("table", &table_called, py::arg("name"),
           "One of them, as read_sto reads it: a dict of columns, with \"time\" (s) first.")
      .def(
          "report", [](const Run& self, const std::filesystem::path& path) { return report({self}, path); },
          py::arg("path"), "Writes the HTML report of 'gracilis report'; returns the path.")
      .def("__repr__", [](const RecordedRun& self) {
        return fmt::format("<gracilis.Run '{}': {} frames, {} muscles>", self.folder.string(), self.frame_count,
                           self.muscles.size());
      });
  module.def("report", &report, py::arg("runs"), py::arg("path"),
             R"(Writes the HTML report of 'gracilis report': one file that compares several runs; returns the path.

runs: list of Run or of their folders; the first leads.)");
}

}  // namespace gracilis::python
