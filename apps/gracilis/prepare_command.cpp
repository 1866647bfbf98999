#include "prepare_command.hpp"

#include "handed_preparation.hpp"
#include "prepare_input.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/io/scene/files.hpp>
#include <gracilis/io/scene/preparation_report.hpp>
#include <gracilis/io/scene/scene_assembly.hpp>
#include <gracilis/io/scene/scene_description.hpp>
#include <gracilis/scene/names.hpp>
#include <gracilis/scene/setting_table.hpp>

#ifdef GRACILIS_WITH_PREPARE
#include <gracilis/prepare/prepare_surfaces.hpp>
#endif

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>

namespace gracilis {

namespace fs = std::filesystem;

namespace {

#ifdef GRACILIS_WITH_PREPARE

/// Every file whose surface is read, those that a scene names, too.
std::vector<fs::path> input_files(const PrepareOptions& options) {
  std::vector<fs::path> files = options.files;
  files.insert(files.end(), options.bones.begin(), options.bones.end());
  if (!is_of_scene(options)) return files;
  const SceneDescription scene = read_scene_description(options.files.front(), options.scene.set, options.scene.only);
  const sections::SceneInProgress progress = sections::begin_scene(scene, options.scene);
  const auto take = [&](const SurfaceDescription& surface) {
    if (!surface.box) files.push_back(sections::located(progress, surface.file));
  };
  for (const MuscleDescription& muscle : scene.muscles) take(muscle.surface);
  for (const BoneDescription& bone : scene.bones) take(bone.surface);
  return files;
}

/// Where muscles of these names are written.
std::vector<fs::path> output_files(const std::vector<std::string>& names, const fs::path& folder) {
  std::vector<fs::path> files;
  std::set<std::string> taken;
  for (const std::string& name : names) files.push_back(folder / (file_name_of(name, taken) + ".vtp"));
  return files;
}

/// What is read is not written over: it may be all there is of a scan.
void require_inputs_kept(const std::vector<NamedSurface>& muscles, const PrepareOptions& options) {
  std::vector<std::string> names;
  for (const NamedSurface& muscle : muscles) names.push_back(muscle.name);
  const std::vector<fs::path> outputs = output_files(names, options.out);
  std::vector<Problem> problems;
  for (const fs::path& input : input_files(options)) {
    const auto is_input = [&](const fs::path& output) {
      std::error_code missing;
      return fs::equivalent(input, output, missing);
    };
    if (std::any_of(outputs.begin(), outputs.end(), is_input))
      problems.push_back(
          {input.string(), "", "is read, and would be overwritten by what is written", "name another folder by --out"});
  }
  if (!problems.empty()) throw ConfigurationError(std::move(problems));
}

/// What a run would refuse is not written.
void leave_out_unrunnable(PreparedSurfaces& prepared, std::vector<Problem>& problems) {
  PreparedSurfaces runnable;
  for (std::size_t m = 0; m < prepared.muscles.size(); ++m) try {
      check_surface(prepared.muscles[m], 1, SurfaceRole::muscle, prepared.report.muscles[m].name);
      runnable.muscles.push_back(std::move(prepared.muscles[m]));
      runnable.report.muscles.push_back(std::move(prepared.report.muscles[m]));
    } catch (const InputError& error) {
      for (const Problem& problem : error.problems())
        problems.push_back({problem.file, problem.where, problem.what + ", after preparation, too",
                            "try another --edge-length, or mend it in a mesh editor"});
    }
  prepared.muscles = std::move(runnable.muscles);
  prepared.report.muscles = std::move(runnable.report.muscles);
}

/// Of those muscles that can be, where the others are to go on; otherwise of all or none.
PreparedSurfaces prepared_input(const SceneSurfaces& input, const PrepareOptions& options,
                                std::vector<Problem>& problems) {
  PreparedSurfaces prepared = options.keep_going
                                  ? prepare_possible(input.muscles, input.bones, input.settings, log_lines, problems)
                                  : prepare_surfaces(input.muscles, input.bones, input.settings, log_lines);
  leave_out_unrunnable(prepared, problems);
  stop_at(problems, options);
  return prepared;
}

void write_prepared(const PreparedSurfaces& prepared, const fs::path& folder, bool as_json) {
  create_folder(folder);
  std::vector<std::string> names;
  for (const PreparedMuscleReport& muscle : prepared.report.muscles) names.push_back(muscle.name);
  const std::vector<fs::path> files = output_files(names, folder);
  for (std::size_t m = 0; m < files.size(); ++m)
    write_surface(files[m], prepared.muscles[m].vertices, prepared.muscles[m].faces);
  const std::string report = to_text(prepared.report), json = to_json(prepared.report).dump(2) + "\n";
  write_text_atomically(folder / "report.txt", report);
  write_text_atomically(folder / "report.json", json);
  if (as_json)
    fmt::print("{}", json);
  else
    fmt::print("{}{}\n", report, folder.string());
}

int prepare(const PrepareOptions& options) {
  std::vector<Problem> problems;
  const SceneSurfaces input = read_input(options, problems);
  require_inputs_kept(input.muscles, options);
  const PreparedSurfaces prepared = prepared_input(input, options, problems);
  if (!prepared.muscles.empty()) write_prepared(prepared, options.out, options.json);
  if (!problems.empty()) throw InputError(std::move(problems));
  return static_cast<int>(ExitCode::done);
}

#else

int prepare(const PrepareOptions&) { throw without_prepare(); }

#endif

}  // namespace

void add_prepare_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<PrepareOptions>();
  CLI::App* command = program.add_subcommand(
      "prepare", "Repair surfaces, remesh them and pull overlaps apart; writes .vtp in metres and a report");
  command->add_option("FILE", options->files, "Surfaces of muscles, or one scene file")->required();
  command->add_option("--out", options->out, "Folder to write")->required();
  command->add_option("--bone", options->bones, "Surfaces that stay as they are and that muscles keep out of")
      ->delimiter(',');
  command->add_option("--unit", options->unit, "Unit of the files (not of a scene): m, cm or mm")
      ->check(CLI::IsMember({"m", "cm", "mm"}));
  command->add_option("--part", options->parts, "Only these meshes of .glb files, by their names, separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option(
          "--apart", options->apart,
          "Pull only these muscles apart, from the others, which stay, and from bones, or pairs (soleus:plantaris), "
          "each from the other alone; separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_flag("--merge", options->merge, "Make one surface of all files: what any of them encloses");
  command->add_flag("--split", options->split, "Make a surface of each closed piece");
  command->add_flag("--largest", options->largest, "Keep of each surface the closed piece that encloses most");
  command->add_option("--data", options->scene.data, "Folder with a scene's files");
  command->add_option("--only", options->scene.only, "Only these muscles of a scene; names separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_flag("--json", options->json, "Print the report as JSON (report.json of the folder), for programs");
  command->add_flag("--keep-going", options->keep_going,
                    "Write the other muscles where some cannot be prepared; these are named, with exit code 3");
  for (const Setting<PrepareSettings>& setting : setting_table<PrepareSettings>()) {
    const auto keep = [options, key = std::string(setting.key)](const SettingValue& value) {
      options->settings[key] = value;
    };
    if (setting.kind == SettingKind::flag)
      command->add_flag_callback(
          option_name(setting), [keep] { keep(true); }, std::string(setting.meaning));
    else
      command->add_option_function<Real>(option_name(setting), keep,
                                         fmt::format("{} Takes {}", setting.meaning, expectation(setting)));
  }
  command->callback([&chosen, options] { chosen = [options] { return prepare(*options); }; });
}

}  // namespace gracilis
