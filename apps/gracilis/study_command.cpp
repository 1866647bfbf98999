#include "study_command.hpp"

#include "console.hpp"
#include "exit_handling.hpp"
#include "handed_preparation.hpp"
#include "session.hpp"
#include "study_listing.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/study/collect.hpp>
#include <gracilis/study/run_study.hpp>
#include <gracilis/study/study_reader.hpp>
#include <gracilis/study/trajectories.hpp>
#include <gracilis/view/study/study_page.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace gracilis {

namespace {

struct StudyOptions {
  std::filesystem::path file, out, report;
  std::string shard = "1/1";
  std::vector<std::string> names, words;
  bool retry = false, names_only = false, no_probe = false, all_runs = false, hdf5 = false, json = false;
  int threads = 1, worst = 6;
};

Study study_of(const StudyOptions& options) {
  Study study = read_study(options.file);
  if (!options.out.empty()) study.folder = options.out;
  return study;
}

LoadedScene load(const Study& study, const StudyRun& run) {
  SceneOptions scene;
  scene.set = run.set;
  scene.only = study.only;
  scene.data = study.data;
  scene.prepare = scene_preparation();
  scene.say = log_lines;
  const std::filesystem::path file = scene_file(study, run);
  return load_scene(file.empty() ? run.scene : file.string(), scene, run.flexion_deg);
}

int run_one(const Study& study, const StudyRun& run, const StudyOptions& options, const std::filesystem::path& folder,
            bool resume) {
  set_up_logging();  // stderr is a file now, without colors
  SessionOptions session;
  session.out = folder;
  session.resume = resume;
  session.force = !resume;
  session.yes = true;
  session.print_folder = false;
  session.threads = options.threads;
  session.measures = study.recording.measures;
  session.without_fibers = !study.recording.fibers;
  session.without_ramps = !study.recording.ramps;
  session.fiber_actions = study.recording.arms;
  session.pictures = study.recording.pictures;
  session.every = study.recording.every;
  session.layout = study.recording.layout;
  session.command = options.words;
  return run_session(load(study, run), session);
}

/// "2/8": the second of eight.
Shard shard_of(const std::string& text) {
  const std::size_t slash = text.find('/');
  Index number = 0, count = 0;
  const bool is_one = slash != std::string::npos && parse_index(text.substr(0, slash), number) &&
                      parse_index(text.substr(slash + 1), count) && number >= 1 && number <= count;
  if (!is_one)
    throw ConfigurationError(
        {"--shard", "", "'" + text + "' is no shard", "2/8 is the second of eight; the first is 1/8"});
  return {number, count};
}

/// Where the study is new, its first and its last run are read: what neither can be is wrong with the study and told at
/// once. In a process of its own, for runs are started by fork.
void check_scenes(const Study& study) {
  if (std::filesystem::exists(study.folder / "runs") || std::filesystem::exists(study.folder / "failures")) return;
  std::string reason;
  ExitCode first_code = ExitCode::usage;
  for (const StudyRun* run : {&study.runs.front(), &study.runs.back()}) {
    ChildOptions silent;
    silent.log = "/dev/null";
    const ChildOutcome outcome = run_in_child(
        [&] {
          load(study, *run);
          return 0;
        },
        silent);
    const auto code = static_cast<ExitCode>(outcome.code);
    if (code != ExitCode::usage && code != ExitCode::unreadable_input) return;
    if (reason.empty()) reason = outcome.reason, first_code = code;
  }
  throw Error(first_code, reason);
}

StudyEnd run_some(const Study& study, const StudyOptions& options, const Shard& shard,
                  const std::vector<std::string>& names) {
  StudyRunOptions how;
  how.version = GRACILIS_VERSION;
  how.shard = shard;
  how.names = names;
  how.retry = options.retry;
  how.is_asked_to_stop = [] { return stop_requested().load(); };
  how.say = [](const std::string& line) { spdlog::info("{}", line); };
  return run_study(
      study,
      [&](const StudyRun& run, const std::filesystem::path& folder, bool resume) {
        return run_one(study, run, options, folder, resume);
      },
      how);
}

int run_shard(const StudyOptions& options) {
  const Study study = study_of(options);
  const Shard shard = shard_of(options.shard);
  stop_requested();  // from here on a signal ends the study between frames
  check_scenes(study);
  const StudyEnd end = run_some(study, options, shard, options.names);
  if (options.json)
    fmt::print("{}", json_text({{"folder", study.folder.string()},
                                {"complete_before", end.complete_before},
                                {"done", end.done},
                                {"failed", end.failed},
                                {"interrupted", end.interrupted}}));
  else
    fmt::print("{} complete before, {} done now, {} failed{}\n", end.complete_before, end.done, end.failed,
               end.interrupted ? "; interrupted: the same command goes on" : "");
  if (end.interrupted) return static_cast<int>(ExitCode::interrupted);
  return static_cast<int>(end.failed > 0 ? ExitCode::quality : ExitCode::done);
}

/// The run in the middle, which is done for good.
int plan(const StudyOptions& options) {
  const Study study = study_of(options);
  if (options.names_only) {
    for (const StudyRun& run : study.runs) fmt::print("{}\n", run.name);
    return static_cast<int>(ExitCode::done);
  }
  std::vector<RunStanding> standings = standings_of(study, GRACILIS_VERSION);
  const bool is_known = std::any_of(standings.begin(), standings.end(),
                                    [](const RunStanding& each) { return each.state == RunState::complete; });
  if (!is_known && !options.no_probe) {
    stop_requested();
    check_scenes(study);
    const StudyRun& probe = study.runs[study.runs.size() / 2];
    spdlog::info("probe: run {}, which stays", probe.name);
    if (run_some(study, options, {}, {probe.name}).interrupted) return static_cast<int>(ExitCode::interrupted);
    standings = standings_of(study, GRACILIS_VERSION);
  }
  if (options.json) {
    fmt::print("{}", json_text(plan_json(study, standings)));
    return static_cast<int>(ExitCode::done);
  }
  fmt::print("{}", plan_table(study, standings));
  for (const std::string& line : estimate_lines(study, standings)) spdlog::info("{}", line);
  return static_cast<int>(ExitCode::done);
}

int collect(const StudyOptions& options) {
  const Study study = study_of(options);
  const CollectEnd end = collect_study(study, GRACILIS_VERSION);
  spdlog::info("{} runs, {:.0f} numbers; {} failed, {} are not complete yet", end.collected, end.rows, end.failed,
               end.left);
  if (!end.remark.empty()) spdlog::warn("{}", end.remark);
  std::vector<std::string> files;
  for (const char* file : {"measures.csv", "frames.csv", "runs.csv", "failures.csv"})
    files.push_back((study.folder / file).string());
  if (options.hdf5) {
    const TrajectoryEnd trajectories = write_trajectories(study, GRACILIS_VERSION);
    for (const std::string& line : trajectories.skipped) spdlog::warn("left out of the trajectories: {}", line);
    spdlog::info("trajectories of {} runs", trajectories.runs);
    files.push_back((study.folder / trajectory_file).string());
  }
  if (options.json)
    fmt::print("{}", json_text({{"collected", end.collected},
                                {"failed", end.failed},
                                {"left", end.left},
                                {"remark", end.remark},
                                {"files", files}}));
  else
    for (const std::string& file : files) fmt::print("{}\n", file);
  return static_cast<int>(ExitCode::done);
}

int report(const StudyOptions& options) {
  const Study study = study_of(options);
  const std::filesystem::path out = options.report.empty() ? study.folder / "report.html" : options.report;
  create_folder_of(out);
  write_study_page(out, study, GRACILIS_VERSION, options.worst,
                   [](const std::string& line) { spdlog::warn("{}", line); });
  fmt::print("{}\n", out.string());
  return static_cast<int>(ExitCode::done);
}

CLI::App* add_part(CLI::App& study, const std::string& name, const std::string& meaning, StudyOptions& options) {
  CLI::App* part = study.add_subcommand(name, meaning);
  part->footer("Example: gracilis study " + name + " study.toml");
  part->add_option("STUDY", options.file, "What to run: .toml (docs/guide/studies.md), or .csv with a run per row")
      ->required();
  part->add_option("--folder", options.out, "What the study leaves behind (default: as it says, or named like it)");
  return part;
}

}  // namespace

void add_study_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen) {
  const auto options = std::make_shared<StudyOptions>();
  options->words = words;
  CLI::App* study = program.add_subcommand("study",
                                           "Many runs of scenes with changed settings, in any number of "
                                           "processes, and one table of what they measured");
  study->require_subcommand(1);
  const auto chooses = [&chosen, options](int (*what)(const StudyOptions&)) {
    return [&chosen, options, what] { chosen = [options, what] { return what(*options); }; };
  };
  CLI::App* planned = add_part(*study, "plan", "List the runs, and estimate their cost from one of them", *options);
  planned->add_flag("--names", options->names_only, "The names of the runs alone, a line each");
  planned->add_flag("--no-probe", options->no_probe, "Do no run to estimate from");
  planned->add_flag("--json", options->json, "Print runs and estimate as JSON, for programs")->excludes("--names");
  CLI::App* running = add_part(*study, "run", "Do what is not complete", *options);
  running->add_option("--shard", options->shard, "I/N: every Nth run from the Ith on (1/1)");
  running->add_option("--run", options->names, "These runs alone, by their names")->excludes("--shard");
  running->add_option("--threads", options->threads, "Threads of each run; 0 takes all (1)")
      ->check(CLI::Range(0, 1024));
  running->add_flag("--retry", options->retry, "Also try again what has failed");
  running->add_flag("--json", options->json, "Print JSON, for programs");
  running->footer(
      "Exit codes: 0 all of the shard is complete; 2 the study is wrong; 3 its files cannot be read or written; 5 some "
      "runs have failed, the others are complete (collect and status have the reasons); 130 interrupted: the same "
      "command goes on.\n\n"
      "Example: gracilis study run study.toml --shard 1/4");
  CLI::App* status = add_part(*study, "status", "Count what is complete, under way, failed and to do", *options);
  status->add_flag("--runs", options->all_runs, "A line for every run");
  status->add_flag("--json", options->json, "Print JSON with every run, for programs");
  CLI::App* collecting = add_part(*study, "collect", "Write one table of all measures, and one of all runs", *options);
  collecting->add_flag("--hdf5", options->hdf5,
                       "Also write trajectories.h5: surfaces, fibers, poses and measures of every frame (HDF5)");
  collecting->add_flag("--json", options->json, "Print counts and files as JSON, for programs");
  CLI::App* reporting =
      add_part(*study, "report", "Distributions, sensitivities and the worst runs in one HTML file", *options);
  reporting->add_option("--out", options->report, "File to write (default: report.html in the study's folder)");
  reporting->add_option("--worst", options->worst, "How many of the worst runs to show (6)")->check(CLI::Range(0, 100));
  planned->callback(chooses(plan));
  running->callback(chooses(run_shard));
  status->callback(chooses([](const StudyOptions& asked) {
    const Study of = study_of(asked);
    if (asked.json) {
      const nlohmann::ordered_json found = status_json(of, standings_of(of, GRACILIS_VERSION));
      fmt::print("{}", json_text(found));
      return static_cast<int>(ExitCode::done);
    }
    fmt::print("{}", status_text(of, standings_of(of, GRACILIS_VERSION), asked.all_runs));
    return static_cast<int>(ExitCode::done);
  }));
  collecting->callback(chooses(collect));
  reporting->callback(chooses(report));
}

}  // namespace gracilis
