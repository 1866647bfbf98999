#include "running.hpp"

#include "errors.hpp"
#include "released.hpp"
#include "scene_handle.hpp"

#include <gracilis/io/suggestions.hpp>
#include <gracilis/view/session/session.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include <algorithm>
#include <exception>

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
          {"large", "", "the run takes " + room_text(plan), "large=True runs it; or use every=, ramps=, layout="});
    result = record_session(loaded, chosen, std::move(plan), listener);
  }
  if (raised) std::rethrow_exception(raised);
  if (result.code == ExitCode::interrupted) raise_interrupt();
  return result;
}

py::object run(const SceneHandle& scene, const std::optional<std::filesystem::path>& out, const py::object& progress,
               bool resume, bool force, int every, bool ramps, bool fibers, const std::string& metrics,
               const std::optional<std::string>& layout, bool arms, int threads, bool strict, bool large) {
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

}  // namespace

void bind_running(py::module_& module) {
  module.def("run", &run, py::arg("scene"), py::arg("out") = py::none(), py::kw_only(),
             py::arg("progress") = py::none(), py::arg("resume") = false, py::arg("force") = false,
             py::arg("every") = 1, py::arg("ramps") = true, py::arg("fibers") = true, py::arg("metrics") = "full",
             py::arg("layout") = py::none(), py::arg("arms") = false, py::arg("threads") = 0, py::arg("strict") = false,
             py::arg("large") = false,
             R"(Takes the scene through its whole motion into a run folder, as `gracilis run` does with the same bits.

out: the folder (runs/NAME of the scene). progress: called after each frame as progress(done, last), perhaps on another
thread; what it raises ends the run. Ctrl-C ends it, too, with every frame so far on disk; resume=True goes on, force=True replaces a run. every:
record every which frame. ramps, fibers: whether to record them. metrics: none, light or full. layout: surfaces or
compact. arms: also moment arms (method strings). strict: QualityError where a gate is missed. large: allow more than
2 GB. Returns the Run.)");
}

}  // namespace gracilis::python
