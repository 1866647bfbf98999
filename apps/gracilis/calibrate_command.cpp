#include "calibrate_command.hpp"

#include "exit_handling.hpp"
#include "prepare_command.hpp"
#include "scene_options.hpp"

#include <gracilis/calibrate/calibration_files.hpp>
#include <gracilis/calibrate/target_reader.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/core/shell_word.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/run/folder_lock.hpp>
#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/study/child_process.hpp>
#include <gracilis/view/calibration/calibration_page.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <thread>

namespace gracilis {

namespace {

struct CalibrateOptions {
  std::filesystem::path scene, targets, out;
  SceneOptions of_scene;
  int jobs = 0, threads = 1;
  bool force = false, json = false;

  bool is_built_in() const { return builtin_scene_of(scene.string()).has_value(); }
};

LoadedScene load_with(const CalibrateOptions& options, const std::vector<std::string>& set) {
  SceneOptions of_scene = options.of_scene;
  of_scene.set.insert(of_scene.set.end(), set.begin(), set.end());
  return load_scene(options.scene.string(), of_scene);
}

/// What the scene says of the calibration, asked in a process of its own, for evaluations are started by fork.
SceneMatch ask_scene(const Calibration& calibration, const CalibrateOptions& options) {
  const std::filesystem::path answer =
      std::filesystem::temp_directory_path() / fmt::format("gracilis_scene_match_{}.json", ::getpid());
  ChildOptions silent;
  silent.log = "/dev/null";
  const ChildOutcome outcome = run_in_child(
      [&] {
        const ThreadLimit limit(options.threads);
        write_text_atomically(answer, to_text(match_scene(calibration, load_with(options, {}))));
        return 0;
      },
      silent);
  if (outcome.code != 0) throw Error(static_cast<ExitCode>(outcome.code), outcome.reason);
  SceneMatch match = match_from_text(read_text(answer));
  std::filesystem::remove(answer);
  return match;
}

std::string definition_of(const CalibrateOptions& options) {
  std::string text = fmt::format("gracilis {}\nscene {}\n", GRACILIS_VERSION, options.scene.filename().string());
  for (const std::string& word : options.of_scene.set) text += "set " + word + "\n";
  for (const std::string& name : options.of_scene.only) text += "only " + name + "\n";
  return text;
}

/// A table's columns for single fibers need no line each.
void tell_absent(const std::vector<std::string>& names) {
  constexpr std::size_t most_told = 8;
  if (names.empty()) return;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most_told); ++i) text += (i > 0 ? ", " : "") + names[i];
  if (names.size() > most_told) text += fmt::format(" and {} more", names.size() - most_told);
  spdlog::info("not muscles of the scene, and left out of the targets: {}", text);
}

/// Command lines that run the scene with what was found.
std::string use_of(const CalibrateOptions& options, const CalibrationResult& result) {
  std::string text;
  if (!options.is_built_in())
    text = "gracilis run " + shell_word((options.out / "calibrated_scene.toml").string()) + "\n\n";
  text += options.scene == "demo"         ? "gracilis demo"
          : options.scene == "demo-elbow" ? "gracilis demo elbow"
                                          : "gracilis run " + shell_word(options.scene.string());
  for (const std::string& word : options.of_scene.set) text += " --set " + shell_word(word);
  for (std::size_t p = 0; p < result.best_values.size(); ++p)
    text += " --set " + shell_word(result.calibration.parameters[p].setting.key + "=" + result.best_values[p]);
  return text + "\n";
}

void print_result(const CalibrationResult& result) {
  const std::vector<CalibrationParameter>& parameters = result.calibration.parameters;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const ParameterEstimate estimate = estimate_of(result, p);
    fmt::print("{} = {:.6g}", parameters[p].setting.key, estimate.value);
    if (std::isfinite(estimate.error)) fmt::print(" ± {:.2g}", estimate.error);
    fmt::print(" (began at {:.6g})", std::stod(result.start_values[p]));
    const std::string& remark = result.uncertainty.remarks[p];
    fmt::print("{}\n", remark.empty() ? "" : ": " + remark);
  }
  for (const std::vector<Index>& together : result.uncertainty.together) {
    if (together.size() < 2) continue;
    fmt::print("only a combination is determined of:");
    for (const Index p : together) fmt::print(" {}", parameters[static_cast<std::size_t>(p)].setting.key);
    fmt::print("\n");
  }
  for (std::size_t t = 0; t < result.calibration.targets.size(); ++t) {
    const CalibrationTarget& target = result.calibration.targets[t];
    const Real factor = shown_factor(target.kind);
    const Real after = factor * target_rms(target, result.after[t]);
    fmt::print("{}{}: {:.3g} {} RMS before, {} after (tolerance {:g})\n", target.name,
               target.held_out ? ", held out" : "", factor * target_rms(target, result.before[t]),
               shown_unit(target.kind), std::isfinite(after) ? fmt::format("{:.3g}", after) : "unknown",
               factor * target.tolerance);
  }
}

/// What is not known is NaN, which JSON has as null.
void print_json(const CalibrationResult& result) {
  nlohmann::ordered_json parameters = nlohmann::json::array(), together = parameters, targets = parameters;
  const auto key_of = [&](std::size_t p) { return result.calibration.parameters[p].setting.key; };
  for (std::size_t p = 0; p < result.calibration.parameters.size(); ++p) {
    const ParameterEstimate estimate = estimate_of(result, p);
    parameters.push_back({{"key", key_of(p)},
                          {"start", std::stod(result.start_values[p])},
                          {"value", estimate.value},
                          {"standard_error", estimate.error},
                          {"from_95", estimate.from},
                          {"to_95", estimate.to},
                          {"remark", result.uncertainty.remarks[p]}});
  }
  for (const std::vector<Index>& each : result.uncertainty.together) {
    nlohmann::ordered_json keys = nlohmann::json::array();
    for (const Index p : each) keys.push_back(key_of(static_cast<std::size_t>(p)));
    if (each.size() > 1) together.push_back(std::move(keys));
  }
  for (std::size_t t = 0; t < result.calibration.targets.size(); ++t) {
    const CalibrationTarget& target = result.calibration.targets[t];
    const Real factor = shown_factor(target.kind);
    targets.push_back({{"name", target.name},
                       {"held_out", target.held_out},
                       {"unit", shown_unit(target.kind)},
                       {"rms_before", factor * target_rms(target, result.before[t])},
                       {"rms_after", factor * target_rms(target, result.after[t])},
                       {"tolerance", factor * target.tolerance}});
  }
  fmt::print("{}", json_text({{"parameters", parameters},
                              {"only_together", together},
                              {"targets", targets},
                              {"evaluations", result.evaluations},
                              {"stopped", result.stopped}}));
}

CalibrationResult run_or_say_how_to_go_on(const Calibration& calibration, const SceneMatch& match,
                                          const ObserveFunction& observe_scene, const CalibrationOptions& how) {
  try {
    return run_calibration(calibration, match, observe_scene, how);
  } catch (const Interrupted&) {
    spdlog::info("the same command goes on where this one ends");
    throw;
  }
}

int calibrate(CalibrateOptions options) {
  if (options.out.empty()) options.out = options.targets.parent_path() / options.targets.stem();
  const Calibration calibration = read_targets(options.targets, options.of_scene.data);
  if (!options.is_built_in()) require_readable_file(options.scene);
  stop_requested();  // from here on a signal ends evaluations, and what was seen stays
  const SceneMatch match = ask_scene(calibration, options);
  create_folder(options.out);
  const FolderLock lock(options.out);
  tell_absent(match.absent);
  const ObserveFunction observe_scene = [&](const std::vector<std::string>& set,
                                            const std::vector<CalibrationTarget>& targets) {
    const ThreadLimit limit(options.threads);
    return observe(load_with(options, set), targets, stop_requested());
  };
  CalibrationOptions how;
  how.folder = options.out;
  how.definition = definition_of(options);
  how.at_once = options.jobs > 0 ? options.jobs : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  how.force = options.force;
  how.is_asked_to_stop = [] { return stop_requested().load(); };
  how.say = [](const std::string& line) { spdlog::info("{}", line); };
  const CalibrationResult result = run_or_say_how_to_go_on(calibration, match, observe_scene, how);
  write_calibration_files(
      options.out, result,
      {options.is_built_in() ? std::filesystem::path() : options.scene, options.of_scene.set, options.of_scene.only});
  write_calibration_page(options.out / "report.html", result, use_of(options, result));
  spdlog::info("{} evaluations, {} of them known before; ended since {}", result.evaluations, result.known,
               result.stopped);
  if (options.json) {
    print_json(result);
    return static_cast<int>(ExitCode::done);
  }
  print_result(result);
  for (const char* file : {"calibrated.toml", "report.html"}) fmt::print("{}\n", (options.out / file).string());
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_calibrate_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<CalibrateOptions>();
  CLI::App* command = program.add_subcommand(
      "calibrate",
      "Find settings with which a scene comes nearest to measured moment arms, lengths, volumes or shapes");
  add_scene_options(*command, options->scene, options->of_scene);
  command->get_option("SCENE")->description("Scene file (TOML); or demo, demo-elbow: the built-in hip and elbow");
  command
      ->add_option("--targets", options->targets,
                   "What is aimed at, and which settings may change within which bounds (.toml; "
                   "docs/guide/calibration.md)")
      ->required();
  command->add_option("--out", options->out, "What it leaves behind (default: named like the targets)");
  command->add_option("--jobs", options->jobs, "Evaluations at once, each a process; 0: one per processor (0)")
      ->check(CLI::Range(0, 1024));
  command->add_option("--threads", options->threads, "Threads of each evaluation; 0 takes all (1)")
      ->check(CLI::Range(0, 1024));
  command->add_flag("--json", options->json, "Print what was found as JSON, for programs");
  command->add_flag("--force", options->force, "Begin anew where the folder holds another calibration");
  command->footer(
      "Killed or interrupted, the same command goes on: nothing is evaluated twice.\n"
      "Exit codes: 0 done; 2 targets, parameters or scene are wrong; 3 files cannot be read or written; 5 the scene "
      "cannot be evaluated where the search begins; 130 interrupted.\n");
  command->callback([&chosen, options] { chosen = [options] { return calibrate(*options); }; });
}

}  // namespace gracilis
