#include "compare_command.hpp"

#include "handed_preparation.hpp"
#include "scene_options.hpp"
#include "session.hpp"
#include "size_question.hpp"

#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/io/scene/scene_changes.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/view/comparison/comparison_page.hpp>
#include <gracilis/view/pictures/run_picture.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <optional>

namespace gracilis {

namespace {

struct CompareOptions {
  std::string scene;
  std::vector<std::string> methods = {"xpbd", "pbd", "arap", "skinning"};
  std::vector<int> frames;
  std::optional<Real> flexion_deg;  ///< of the built-in scenes
  SceneOptions scene_options;
  SessionOptions session;
};

/// The scene for one of the methods: as it is where that is its own, with the method's defaults otherwise, or with a
/// preset.
LoadedScene scene_by(const std::string& name, const LoadedScene& loaded) {
  LoadedScene result = loaded;
  if (find_method(name)) {
    if (name == loaded.scene.method.name) return result;
    result.scene.method = {name, {}, {}};
    result.preset = "none";
    for (Muscle& muscle : result.scene.muscles) muscle.settings.clear();
    return result;
  }
  change_to_preset(*find_preset(name), result);
  return result;
}

/// Everything that is wrong with the list, at once.
void check_names(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const MethodEntry& method : methods()) known.emplace_back(method.name);
  for (const Preset& preset : presets()) known.emplace_back(preset.name);
  std::vector<Problem> problems;
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(known.begin(), known.end(), *name) == known.end())
      problems.push_back({"--methods", "", "there is no method or preset '" + *name + "'", suggestion(*name, known)});
    else if (std::find(names.begin(), name, *name) != name)
      problems.push_back({"--methods", "", "'" + *name + "' is there twice", ""});
  }
  if (!problems.empty()) throw ConfigurationError(problems);
}

/// All scenes, before the first runs. Throws ConfigurationError where a method cannot take the scene.
std::vector<LoadedScene> scenes_of(const std::vector<std::string>& names, const LoadedScene& loaded) {
  std::vector<LoadedScene> scenes;
  std::vector<Problem> problems;
  for (const std::string& name : names) {
    scenes.push_back(scene_by(name, loaded));
    Scene& scene = scenes.back().scene;
    if (!scene.transversals.empty() && !method_of(scene).takes_transversals) {
      spdlog::warn("{}: the scene's transversals are left out, which it does not know", name);
      scene.transversals.clear();
    }
    for (Problem problem : validate_method(scenes.back().scene)) {
      problem.file = "--methods " + name;
      problems.push_back(std::move(problem));
    }
  }
  if (!problems.empty()) throw ConfigurationError(problems);
  return scenes;
}

std::string meaning_of(const std::string& name) {
  if (const MethodEntry* method = find_method(name)) return std::string(method->meaning);
  const Preset preset = *find_preset(name);
  return std::string(preset.method.name) + ": " + std::string(preset.meaning);
}

/// Before anything runs. Throws ConfigurationError.
void check_frames(const std::vector<int>& frames, const LoadedScene& loaded) {
  const int count = static_cast<int>(pose_sequence(loaded.scene, loaded.max_frames).size());
  for (const int frame : frames)
    if (frame < 0 || frame >= count)
      throw ConfigurationError({"--frames", "", fmt::format("there is no frame {}", frame),
                                fmt::format("the runs have frames 0 to {}", count - 1)});
}

/// The frames asked for, or telling ones, of the first run; it may have ended early.
std::vector<int> frames_of(const CompareOptions& options, const RecordedRun& run) {
  std::vector<int> frames = options.frames.empty() ? telling_frames(run) : options.frames;
  std::erase_if(frames, [&](int frame) { return frame >= run.frame_count; });
  return frames;
}

/// The table's rows with the names of its columns; what a run does not tell is null.
void print_json(const std::filesystem::path& folder, const std::vector<ComparedRun>& runs,
                const std::vector<ComparisonRow>& rows) {
  nlohmann::ordered_json methods = nlohmann::json::array(), numbers = methods;
  for (const ComparedRun& run : runs)
    methods.push_back({{"method", run.method}, {"run", (folder / run.method).string()}, {"trouble", run.trouble}});
  for (const ComparisonRow& row : rows) {
    nlohmann::ordered_json told = {{"method", row.method}, {"muscle", row.muscle}};
    for (std::size_t c = 0; c < row.values.size(); ++c) told[std::string(comparison_columns()[c].key)] = row.values[c];
    numbers.push_back(std::move(told));
  }
  fmt::print("{}", json_text({{"page", (folder / "comparison.html").string()},
                              {"table", (folder / "comparison.csv").string()},
                              {"methods", methods},
                              {"rows", numbers}}));
}

void write_comparison(const CompareOptions& options, const std::string& scene, const std::vector<ComparedRun>& runs) {
  const std::vector<int> frames = frames_of(options, runs[0].run);
  const std::filesystem::path& folder = options.session.out;
  spdlog::info("comparing");
  const std::vector<ComparisonRow> rows = comparison_rows(runs, frames);
  write_text_atomically(folder / "comparison.csv", comparison_csv(rows));
  std::vector<ComparisonPicture> pictures;
  try {
    pictures = comparison_pictures(runs, frames);
  } catch (const Error& error) {
    if (error.code() != ExitCode::unsupported) throw;
    spdlog::warn("no pictures: {}", error.what());
  }
  write_comparison_page(folder / "comparison.html", scene, runs, rows, pictures);
  if (options.session.json) return print_json(folder, runs, rows);
  fmt::print("{}\n{}\n", (folder / "comparison.html").string(), (folder / "comparison.csv").string());
}

/// Of all runs at once: nobody wants to be asked in the midst of them.
void confirm_sizes(const std::vector<LoadedScene>& scenes, const SessionOptions& options) {
  RunPlan all = plan_run(scenes[0], options);
  for (std::size_t i = 1; i < scenes.size(); ++i) {
    const RunPlan next = plan_run(scenes[i], options);
    all.size.bytes += next.size.bytes;
    all.size.files += next.size.files;
    all.seconds = all.seconds && next.seconds ? std::optional(*all.seconds + *next.seconds) : std::nullopt;
  }
  confirm_size(all, options, "fewer --methods write less");
}

int compare(const CompareOptions& options) {
  check_names(options.methods);
  const LoadedScene loaded = load_scene(options.scene, options.scene_options, options.flexion_deg);
  check_frames(options.frames, loaded);
  const std::vector<LoadedScene> scenes = scenes_of(options.methods, loaded);
  confirm_sizes(scenes, options.session);
  std::vector<ComparedRun> runs;
  int code = static_cast<int>(ExitCode::done);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const std::string& name = options.methods[i];
    SessionOptions session = options.session;
    session.out = options.session.out / name;
    session.print_folder = false;
    session.yes = true;
    spdlog::info("---- {}", name);
    std::string trouble;
    try {
      const int end = run_session(scenes[i], session);
      if (end == static_cast<int>(ExitCode::interrupted)) return end;
    } catch (const QualityError& error) {
      trouble = error.what();
      spdlog::error("{}: {}", name, trouble);
      code = static_cast<int>(ExitCode::quality);
    }
    runs.push_back({name, meaning_of(name), trouble, open_recorded_run(session.out)});
  }
  write_comparison(options, loaded.scene.name, runs);
  return code;
}

}  // namespace

void add_compare_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* command = program.add_subcommand(
      "compare", "Run one scene by several methods and show them side by side: a page and a table of numbers");
  options->scene_options.prepare = scene_preparation();
  options->scene_options.say = log_lines;
  command
      ->add_option("SCENE", options->scene,
                   "Scene file, demo for the built-in hip, or demo-elbow for the built-in elbow")
      ->required();
  command
      ->add_option(
          "--methods", options->methods,
          "Methods, or presets of methods, separated by commas (xpbd,pbd,arap,skinning). The scene's own method "
          "runs by the scene's settings, others by their defaults")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--out", options->session.out,
                   "Folder to write: comparison.html, comparison.csv, pictures and a run folder per method")
      ->required();
  command->add_option("--flexion", options->flexion_deg, "How far a built-in joint flexes, degrees (hip 90, elbow 130)")
      ->check(CLI::Range(0.0, 130.0));
  command->add_option("--frames", options->frames, "Frames to show, as in 0,30,60 (capture, half way, farthest)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--data", options->scene_options.data,
                      "Folder with the scene's files (default: GRACILIS_DATA, or shared/data above the scene file)");
  add_setting_options(*command, options->scene_options);
  command->add_option("--threads", options->session.threads, "Threads to use; 0 takes all. Only times depend on it")
      ->check(CLI::Range(0, 1024));
  CLI::Option* resume = command->add_flag("--resume", options->session.resume,
                                          "Keep the runs that are in the folder, and go on where one was interrupted");
  command->add_flag("--force", options->session.force, "Replace the runs that are in the folder")->excludes(resume);
  command->add_flag("--yes", options->session.yes, "Do not ask before runs that take more than 2 GB together");
  command->add_flag("--json", options->session.json, "Print the table as JSON, for programs");
  command->footer(
      "Exit codes: 0 all methods ran; 2 an unknown method, or one that cannot take the scene; 3 a file is missing or "
      "cannot be written; 5 a method failed (the page says which, and shows what it did until then); 130 interrupted.");
  options->session.command = words;
  command->callback([&chosen, options] { chosen = [options] { return compare(*options); }; });
}

}  // namespace gracilis
