#include "prepare_command.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/core/whole_number.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/io/scene/files.hpp>
#include <gracilis/io/scene/preparation_report.hpp>
#include <gracilis/io/scene/scene_assembly.hpp>
#include <gracilis/io/scene/scene_description.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/scene/names.hpp>
#include <gracilis/scene/setting_table.hpp>

#ifdef GRACILIS_WITH_PREPARE
#include <gracilis/prepare/estimates.hpp>
#include <gracilis/prepare/prepare_surfaces.hpp>
#include <gracilis/prepare/separation.hpp>
#include <gracilis/prepare/surface_repair.hpp>
#endif

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>

namespace gracilis {

namespace fs = std::filesystem;

void log_lines(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) spdlog::info("{}", line);
}

namespace {

struct PrepareOptions {
  std::vector<fs::path> files, bones;
  fs::path out;
  std::string unit;  ///< empty: not given
  bool merge = false, split = false, largest = false, keep_going = false;
  std::map<std::string, SettingValue> settings;  ///< those given on the command line
  SceneOptions scene;
};

/// "--edge-length" of edge_length.
std::string option_name(const Setting<PrepareSettings>& setting) {
  std::string name(setting.key);
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

#ifdef GRACILIS_WITH_PREPARE

Real unit_length(const std::string& unit) { return unit == "mm" ? 0.001 : unit == "cm" ? 0.01 : 1; }

bool is_of_scene(const PrepareOptions& options) {
  return options.files.size() == 1 && options.files.front().extension() == ".toml";
}

/// Options that the input has no use for are refused: nobody would see that they do nothing.
void require_fitting(const PrepareOptions& options) {
  std::vector<Problem> problems;
  const auto refuse = [&](bool given, const char* option, const std::string& remedy) {
    const char* what = is_of_scene(options) ? "is for files of surfaces, and this is a scene"
                                            : "is for a scene, and these are files of surfaces";
    if (given) problems.push_back({"", option, what, remedy});
  };
  if (is_of_scene(options)) {
    refuse(options.split, "--split", "give the muscles' files in the place of the scene");
    refuse(options.merge, "--merge", "give the muscles' files in the place of the scene");
    refuse(options.largest, "--largest", "write piece = \"largest\" at the muscle in the scene");
    refuse(!options.bones.empty(), "--bone", "add the bone to the scene, as [[bones]]");
    refuse(!options.unit.empty(), "--unit", "write unit = \"" + options.unit + "\" beside 'file' in the scene");
  } else {
    refuse(!options.scene.data.empty(), "--data", "give the path of each file");
    refuse(!options.scene.only.empty(), "--only", "give only the files that are wanted");
  }
  if (!problems.empty()) throw ConfigurationError(std::move(problems));
}

void add_problems(const InputError& error, std::vector<Problem>& problems) {
  problems.insert(problems.end(), error.problems().begin(), error.problems().end());
}

/// Bad units and empty files are told of before any work.
TriangleMesh read_sized(const fs::path& file, Real unit) {
  TriangleMesh mesh = read_mesh(file, unit);
  std::vector<Problem> problems = fatal_problems(inspect_mesh(mesh), unit, file.string());
  if (!problems.empty()) throw InputError(std::move(problems));
  return mesh;
}

/// Surfaces under the names of their files; two of one name are told apart by a number. What is wrong with files, which
/// are left out then, is added to `problems`.
std::vector<NamedSurface> read_surfaces(const std::vector<fs::path>& files, Real unit, std::vector<Problem>& problems) {
  std::vector<NamedSurface> surfaces;
  std::map<std::string, int> times;
  for (const fs::path& file : files) {
    const std::string name = file.stem().string();
    const int time = ++times[name];
    try {
      surfaces.push_back({time == 1 ? name : fmt::format("{}_{}", name, time), read_sized(file, unit)});
    } catch (const InputError& error) {
      add_problems(error, problems);
    }
  }
  return surfaces;
}

/// Closed pieces of the surface, mended.
std::vector<TriangleMesh> mended_pieces(const NamedSurface& surface, const PrepareSettings& settings) {
  try {
    return pieces_of(fix_surface(surface.mesh, surface.name, TimeLimit(settings.time_limit)).mesh);
  } catch (const OutOfTime&) {
    throw InputError(out_of_time(surface.name, settings));
  }
}

/// One surface of all, or one of each closed piece, as asked for; pieces are known only of surfaces that are mended.
/// What cannot be mended is left out, and told of in `problems`.
std::vector<NamedSurface> rearranged(std::vector<NamedSurface> surfaces, const PrepareOptions& options,
                                     const PrepareSettings& settings, std::vector<Problem>& problems) {
  for (NamedSurface& surface : surfaces) surface.largest_piece = options.largest;
  if (!options.merge && !options.split) return surfaces;
  std::vector<TriangleMesh> all;
  std::vector<NamedSurface> parts;
  for (const NamedSurface& surface : surfaces) try {
      int number = 0;
      for (TriangleMesh& piece : mended_pieces(surface, settings)) {
        if (options.merge)
          all.push_back(std::move(piece));
        else
          parts.push_back({fmt::format("{}_{}", surface.name, ++number), std::move(piece), false});
      }
    } catch (const InputError& error) {
      add_problems(error, problems);
    }
  if (!options.merge || all.empty()) return parts;
  const TimeLimit limit(settings.time_limit * static_cast<Real>(surfaces.size()));
  const std::vector<TriangleMesh> whole = united(std::move(all), limit).pieces;
  if (!options.split) return {{"merged", merged(whole), options.largest}};
  for (const TriangleMesh& piece : whole) parts.push_back({fmt::format("merged_{}", parts.size() + 1), piece, false});
  return parts;
}

void set_given(PrepareSettings& settings, const PrepareOptions& options) {
  for (const auto& [key, value] : options.settings) {
    const Setting<PrepareSettings>& setting = *find_setting<PrepareSettings>(key);
    const Real* number = std::get_if<Real>(&value);
    const std::optional<int> count =
        number && setting.kind == SettingKind::integer ? whole_number<int>(*number) : std::nullopt;
    // What is no count is refused as the number that it is.
    const std::string wrong = assign(settings, setting, count ? SettingValue(*count) : value);
    if (!wrong.empty()) throw ConfigurationError({"", option_name(setting), wrong, ""});
  }
}

/// Ends here where something is wrong, unless the others are to go on.
void stop_at(const std::vector<Problem>& problems, const PrepareOptions& options) {
  if (!problems.empty() && !options.keep_going) throw InputError(problems);
}

SceneSurfaces read_input(const PrepareOptions& options, std::vector<Problem>& problems) {
  if (is_of_scene(options)) {
    SceneSurfaces scene = read_scene_surfaces(options.files.front(), options.scene);
    set_given(scene.settings, options);
    return scene;
  }
  SceneSurfaces input;
  set_given(input.settings, options);
  const Real unit = unit_length(options.unit);
  std::vector<NamedSurface> muscles = read_surfaces(options.files, unit, problems);
  const std::size_t of_muscles = problems.size();
  input.bones = read_surfaces(options.bones, unit, problems);
  // Without a bone muscles would be left lying in it, and nothing would say so.
  if (problems.size() > of_muscles) throw InputError(std::move(problems));
  stop_at(problems, options);
  input.muscles = rearranged(std::move(muscles), options, input.settings, problems);
  stop_at(problems, options);
  return input;
}

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

void write_prepared(const PreparedSurfaces& prepared, const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw InputError({folder.string(), "", "cannot be made a folder: " + failed.message(), ""});
  std::vector<std::string> names;
  for (const PreparedMuscleReport& muscle : prepared.report.muscles) names.push_back(muscle.name);
  const std::vector<fs::path> files = output_files(names, folder);
  for (std::size_t m = 0; m < files.size(); ++m)
    write_surface(files[m], prepared.muscles[m].vertices, prepared.muscles[m].faces);
  const std::string report = to_text(prepared.report);
  write_text_atomically(folder / "report.txt", report);
  write_text_atomically(folder / "report.json", to_json(prepared.report).dump(2) + "\n");
  fmt::print("{}{}\n", report, folder.string());
}

int prepare(const PrepareOptions& options) {
  require_fitting(options);
  std::vector<Problem> problems;
  const SceneSurfaces input = read_input(options, problems);
  require_inputs_kept(input.muscles, options);
  const PreparedSurfaces prepared = prepared_input(input, options, problems);
  if (!prepared.muscles.empty()) write_prepared(prepared, options.out);
  if (!problems.empty()) throw InputError(std::move(problems));
  return static_cast<int>(ExitCode::done);
}

#else

int prepare(const PrepareOptions&) {
  throw ConfigurationError({"", "", "this program was built without 'prepare'",
                            "install libcgal-dev and build with GRACILIS_WITH_PREPARE=ON"});
}

#endif

}  // namespace

PrepareFunction scene_preparation() {
#ifdef GRACILIS_WITH_PREPARE
  return prepare_surfaces;
#else
  return {};
#endif
}

SeparateFunction scene_separation() {
#ifdef GRACILIS_WITH_PREPARE
  return [](std::vector<TriangleMesh>& muscles, const std::vector<TriangleMesh>& bones) {
    return separate(muscles, bones, {}).shortfall;
  };
#else
  return {};
#endif
}

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
  command->add_flag("--merge", options->merge, "Make one surface of all files: what any of them encloses");
  command->add_flag("--split", options->split, "Make a surface of each closed piece");
  command->add_flag("--largest", options->largest, "Keep of each surface the closed piece that encloses most");
  command->add_option("--data", options->scene.data, "Folder with a scene's files");
  command->add_option("--only", options->scene.only, "Only these muscles of a scene; names separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_flag("--keep-going", options->keep_going,
                    "Write the other muscles where some cannot be prepared; these are named, with exit code 3");
  for (const Setting<PrepareSettings>& setting : setting_table<PrepareSettings>()) {
    const auto keep = [options, key = std::string(setting.key)](SettingValue value) { options->settings[key] = value; };
    if (setting.kind == SettingKind::flag)
      command->add_flag_callback(
          option_name(setting), [keep] { keep(true); }, std::string(setting.meaning));
    else
      command->add_option_function<Real>(option_name(setting), keep,
                                         fmt::format("{} {}", setting.meaning, expectation(setting)));
  }
  command->callback([&chosen, options] { chosen = [options] { return prepare(*options); }; });
}

}  // namespace gracilis
