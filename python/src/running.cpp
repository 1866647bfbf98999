#include "running.hpp"

#include "errors.hpp"
#include "released.hpp"
#include "scene_handle.hpp"

#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/tables/arm_reference.hpp>
#include <gracilis/view/session/coordinate_range.hpp>
#include <gracilis/view/session/session.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <map>
#include <variant>

namespace py = pybind11;

namespace gracilis::python {

namespace {

MeasureLevel level_called(const std::string& name) {
  if (const auto level = measure_level_called(name)) return *level;
  std::vector<std::string> known;
  for (const MeasureLevel level : measure_levels) known.push_back(name_of(level));
  refuse("metrics", "there is no '" + name + "'", suggestion(name, known));
}

std::optional<RunLayout> layout_called(const std::optional<std::string>& name) {
  if (!name) return {};
  if (const auto layout = run_layout_called(*name)) return layout;
  std::vector<std::string> known;
  for (const RunLayout layout : run_layouts) known.push_back(name_of(layout));
  refuse("layout", "there is no '" + *name + "'", suggestion(*name, known));
}

void warn(const std::vector<std::string>& warnings) {
  const py::object kind = py::module_::import("gracilis.errors").attr("SceneWarning");
  for (const std::string& warning : warnings)
    if (PyErr_WarnEx(kind.ptr(), warning.c_str(), 1) != 0) throw py::error_already_set();
}

/// The session without the interpreter's lock; what a callback raises ends it within the frame.
SessionResult record(const LoadedScene& loaded, const SessionOptions& options, const py::object& progress,
                     std::vector<std::string>& warnings) {
  const InterruptWatch watch;
  std::exception_ptr raised;
  SessionListener listener;
  listener.version = GRACILIS_VERSION;
  listener.stop = watch.flag();
  listener.say = [&](MessageKind kind, const std::string& text) {
    const bool known = std::find(loaded.warnings.begin(), loaded.warnings.end(), text) != loaded.warnings.end();
    if (kind == MessageKind::warning && !known) warnings.push_back(text);  // known ones came when the scene was made
  };
  if (!progress.is_none())
    listener.progress = [&](int done, int last) {
      const py::gil_scoped_acquire lock;
      try {
        progress(done, last);
      } catch (const py::error_already_set&) {
        raised = std::current_exception();
      }
      if (raised) throw Interrupted();
    };
  SessionResult result;
  {
    const py::gil_scoped_release release;
    const SessionOptions chosen = as_begun(loaded, options);
    RunPlan plan = plan_run(loaded, chosen);
    if (plan.size.bytes > asking_bytes && !options.yes)
      throw ConfigurationError(
          {"large", "", "the run takes " + cost_text(plan), "large=True runs it; or use every=, ramps=, layout="});
    result = record_session(loaded, chosen, std::move(plan), listener);
  }
  if (raised) std::rethrow_exception(raised);
  if (result.code == ExitCode::interrupted) raise_interrupt();
  return result;
}

py::object run(const SceneHandle& scene, const std::optional<std::filesystem::path>& out, const py::object& progress,
               bool resume, bool force, int every, bool ramps, bool fibers, const std::string& metrics,
               const std::optional<std::string>& layout, bool arms, bool corrections, int threads, bool strict,
               bool large) {
  if (every < 1) refuse("every", "must be 1 or more");
  if (threads < 0) refuse("threads", "must be 0 or more");
  if (resume && force) refuse("resume", "a run that is replaced does not go on", "give resume=True or force=True");
  SessionOptions options;
  options.out = out.value_or("");
  options.threads = threads;
  options.resume = resume;
  options.force = force;
  options.strict = strict;
  options.yes = large;
  options.every = every;
  options.without_ramps = !ramps;
  options.without_fibers = !fibers;
  options.measures = level_called(metrics);
  options.layout = layout_called(layout);
  options.fiber_actions = arms;
  options.corrections = corrections;
  options.print_folder = false;
  options.command = {"gracilis.run"};
  const std::shared_ptr<const LoadedScene> loaded = scene.loaded;
  std::vector<std::string> warnings;
  const SessionResult result = record(*loaded, options, progress, warnings);
  warn(warnings);
  if (result.code == ExitCode::quality)
    throw QualityError(result.folder.string() + ": a quality gate was missed (strict=True); the run is complete");
  return py::module_::import("gracilis").attr("Run")(result.folder);
}

using Range = std::array<Real, 3>;  ///< from, to, step
/// Of other coordinates: each stays at a value or goes through a range.
using OtherCoordinates = std::map<std::string, std::variant<Real, Range>>;

CoordinateRange range_of(const std::string& coordinate, const Range& range, const char* argument) {
  const auto [from, to, step] = range;
  if (!std::isfinite(from) || !std::isfinite(to) || !(step > 0) || !std::isfinite(step) || from == to)
    refuse(argument, "'" + coordinate + "' goes nowhere", "give (from, to, step), degrees (mm for a translation)");
  return {coordinate, from, to, step};
}

/// As the command has them.
std::vector<CoordinateRange> ranges_of(const std::string& coordinate, const Range& range, const OtherCoordinates& at) {
  std::vector<CoordinateRange> ranges = {range_of(coordinate, range, "range")};
  for (const auto& [name, place] : at)
    if (const Range* moves = std::get_if<Range>(&place)) {
      ranges.push_back(range_of(name, *moves, "at"));
    } else {
      const Real value = std::get<Real>(place);
      if (!std::isfinite(value)) refuse("at", "'" + name + "' is not finite");
      ranges.push_back({name, value, value, 0});
    }
  return ranges;
}

py::object rom(const SceneHandle& scene, const std::string& coordinate, const Range& range,
               const std::optional<std::filesystem::path>& out, const OtherCoordinates& at,
               const std::optional<std::filesystem::path>& reference, const py::object& progress, bool resume,
               bool force, const std::string& metrics, int threads, bool large) {
  if (threads < 0) refuse("threads", "must be 0 or more");
  if (resume && force) refuse("resume", "a run that is replaced does not go on", "give resume=True or force=True");
  std::vector<ArmCurve> references;
  if (reference) references = read_arm_reference(*reference, coordinate);
  LoadedScene loaded = *scene.loaded;
  const std::vector<MovedCoordinate> moved = move_through(ranges_of(coordinate, range, at), loaded);
  if (moved.size() > 1 && reference) refuse("reference", "is about one coordinate", "give the others one value");
  SessionOptions options;
  options.out = out.value_or(range_folder(loaded.scene));
  options.threads = threads;
  options.resume = resume;
  options.force = force;
  options.yes = large;
  options.measures = level_called(metrics);
  options.fiber_actions = true;
  options.print_folder = false;
  options.command = {"gracilis.rom"};
  std::vector<std::string> warnings;
  const SessionResult result = record(loaded, options, progress, warnings);
  const MomentArmReport report = write_moment_arms(result.folder, loaded.scene, moved, references);
  warnings.insert(warnings.end(), report.warnings.begin(), report.warnings.end());
  warn(warnings);
  return py::module_::import("gracilis").attr("Run")(result.folder);
}

}  // namespace

void bind_running(py::module_& module) {
  module.def(
      "rom", &rom, py::arg("scene"), py::arg("coordinate"), py::arg("range"), py::arg("out") = py::none(),
      py::kw_only(), py::arg("at") = OtherCoordinates{}, py::arg("reference") = py::none(),
      py::arg("progress") = py::none(), py::arg("resume") = false, py::arg("force") = false,
      py::arg("metrics") = "full", py::arg("threads") = 0, py::arg("large") = false,
      R"(Takes the scene through a coordinate's range into a run folder, as `gracilis rom` does with the same bits.

coordinate, range: its name and (from, to, step), degrees (mm for a translation). out: the folder (runs/NAME_rom of the
scene). at: values of other coordinates, or (from, to, step): the scene then goes through all combinations, the first
coordinate fastest; without either they keep the value of the capture pose. reference: a table of published
moment arms to compare with (reference.csv in the folder). Others: as of run. The folder has moment_arms.sto, or
moment_arms_about_NAME.sto of each coordinate where several move, and plots/moment_arms*.svg. Returns the Run;
moment_arms gives arms alone, without a folder.)");
  module.def("run", &run, py::arg("scene"), py::arg("out") = py::none(), py::kw_only(),
             py::arg("progress") = py::none(), py::arg("resume") = false, py::arg("force") = false,
             py::arg("every") = 1, py::arg("ramps") = true, py::arg("fibers") = true, py::arg("metrics") = "full",
             py::arg("layout") = py::none(), py::arg("arms") = false, py::arg("corrections") = false,
             py::arg("threads") = 0, py::arg("strict") = false, py::arg("large") = false,
             R"(Takes the scene through its whole motion into a run folder, as `gracilis run` does with the same bits.

out: the folder (runs/NAME of the scene). progress: called after each frame as progress(done, last), perhaps on another
thread; what it raises ends the run. Ctrl-C ends it, too, with every frame so far on disk; resume=True goes on, force=True replaces a run. every:
record every which frame. ramps, fibers: whether to record them. metrics: none, light or full. layout: surfaces or
compact. arms: also moment arms (method strings). corrections: what constraints moved, too (method xpbd). strict: QualityError where a gate is missed. large: allow more than
2 GB. Returns the Run.)");
}

}  // namespace gracilis::python
