#include "session.hpp"

#include "console.hpp"
#include "exit_handling.hpp"
#include "size_question.hpp"

#include <gracilis/view/session/table_session.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <map>
#include <optional>

namespace gracilis {

void add_session_options(CLI::App& command, SessionOptions& options) {
  command.add_option("--out", options.out, "Run folder to write (default: runs/NAME of the scene)");
  command.add_option("--threads", options.threads, "Threads to use; 0 takes all. Results do not depend on it")
      ->check(CLI::Range(0, 1024));
  CLI::Option* resume =
      command.add_flag("--resume", options.resume, "Go on where the run in the folder was interrupted");
  command.add_flag("--force", options.force, "Replace the run that is in the folder")->excludes(resume);
  command.add_flag("--yes", options.yes, "Do not ask before a run that takes more than 2 GB");
  command.add_option("--every", options.every, "Record every which frame; all are computed (1)")
      ->check(CLI::Range(1, 1'000'000));
  command.add_flag("--no-ramp", options.without_ramps,
                   "Do not record the frames between the capture pose and the motion; the capture pose stays frame 0");
  command.add_flag("--no-fibers", options.without_fibers, "Do not follow fibers");
  command.add_flag("--corrections", options.corrections,
                   "Frames also tell what each kind of constraint moved each vertex by (method xpbd)");
  command.add_flag_callback(
      "--no-pictures", [&options] { options.pictures = false; }, "Draw no charts and no preview at the end");
  std::map<std::string, MeasureLevel> levels;
  for (const MeasureLevel level : measure_levels) levels[name_of(level)] = level;
  command
      .add_option(
          "--metrics", options.measures,
          "What is measured: none; light: volume, edges and angles; full: depth in bones and places, too (full)")
      ->transform(CLI::CheckedTransformer(levels));
  std::map<std::string, RunLayout> layouts;
  for (const RunLayout layout : run_layouts) layouts[name_of(layout)] = layout;
  command
      .add_option(
          "--layout", options.layout,
          "How frames lie in the folder: surfaces, a file per muscle, bone and frame; or compact, one per frame, in a "
          "fifth to a tenth of the room (surfaces; compact where they took more than 2 GB or 20,000 files)")
      ->transform(CLI::CheckedTransformer(layouts));
  command.add_flag("--verbose", options.verbose, "Also list muscles, attachments, counters and every gate missed");
  command.add_flag("--json", options.json,
                   "Print how the run went as JSON, for programs: frames, seconds, gates, warnings, picture");
  command.add_flag("--strict", options.strict, "Exit with code 5 when a frame misses a quality gate");
}

int run_session(const LoadedScene& loaded, const SessionOptions& options) {
  if (options.verbose) spdlog::set_level(spdlog::level::debug);
  const SessionOptions chosen = as_begun(loaded, options);
  std::optional<RunPlan> plan;
  if (!chosen.tables_only) {
    plan = plan_run(loaded, chosen);
    confirm_size(*plan, chosen);
  }
  std::optional<Progress> progress;
  SessionListener listener;
  listener.version = GRACILIS_VERSION;
  listener.stop = &stop_requested();  // from here on a signal ends the run, but not while a frame is written
  listener.say = [&](MessageKind kind, const std::string& text) {
    if (progress) progress->clear();
    const auto level = kind == MessageKind::detail ? spdlog::level::debug
                       : kind == MessageKind::note ? spdlog::level::info
                                                   : spdlog::level::warn;
    spdlog::log(level, "{}", text);
  };
  listener.begin = [&](int first, int last) { progress.emplace(first, last); };
  listener.progress = [&](int done, int last) {
    progress->show(done);
    if (done == last) progress->clear();
  };
  const SessionResult result =
      plan ? record_session(loaded, chosen, *std::move(plan), listener) : record_tables(loaded, chosen, listener);
  if (options.print_folder && options.json)
    fmt::print("{}", result.told);
  else if (options.print_folder && result.code != ExitCode::interrupted)
    fmt::print("{}\n", result.folder.string());
  return static_cast<int>(result.code);
}

}  // namespace gracilis
