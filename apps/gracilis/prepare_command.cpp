#include "prepare_command.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/core/whole_number.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/io/scene/preparation_report.hpp>
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
  std::string unit = "m";
  bool merge = false, split = false, largest = false;
  std::map<std::string, Real> settings;  ///< those given on the command line
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

/// Surfaces under the names of their files; two of one name are told apart by a number.
std::vector<NamedSurface> read_surfaces(const std::vector<fs::path>& files, Real unit) {
  std::vector<NamedSurface> surfaces;
  std::map<std::string, int> times;
  for (const fs::path& file : files) {
    const std::string name = file.stem().string();
    const int time = ++times[name];
    surfaces.push_back({time == 1 ? name : fmt::format("{}_{}", name, time), read_mesh(file, unit)});
  }
  return surfaces;
}

/// Bad units and empty files are told of before any work.
void require_sizes(const std::vector<NamedSurface>& surfaces, const std::vector<fs::path>& files, Real unit) {
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const std::vector<Problem> some = fatal_problems(inspect_mesh(surfaces[i].mesh), unit, files[i].string());
    problems.insert(problems.end(), some.begin(), some.end());
  }
  if (!problems.empty()) throw InputError(std::move(problems));
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
std::vector<NamedSurface> rearranged(std::vector<NamedSurface> surfaces, const PrepareOptions& options,
                                     const PrepareSettings& settings) {
  for (NamedSurface& surface : surfaces) surface.largest_piece = options.largest;
  if (!options.merge && !options.split) return surfaces;
  std::vector<TriangleMesh> all;
  std::vector<NamedSurface> parts;
  for (const NamedSurface& surface : surfaces) {
    int number = 0;
    for (TriangleMesh& piece : mended_pieces(surface, settings)) {
      if (options.merge)
        all.push_back(std::move(piece));
      else
        parts.push_back({fmt::format("{}_{}", surface.name, ++number), std::move(piece), false});
    }
  }
  if (!options.merge) return parts;
  const TimeLimit limit(settings.time_limit * static_cast<Real>(surfaces.size()));
  const std::vector<TriangleMesh> whole = united(std::move(all), limit).pieces;
  if (!options.split) return {{"merged", merged(whole), options.largest}};
  for (const TriangleMesh& piece : whole) parts.push_back({fmt::format("merged_{}", parts.size() + 1), piece, false});
  return parts;
}

void set_given(PrepareSettings& settings, const PrepareOptions& options) {
  for (const auto& [key, value] : options.settings) {
    const Setting<PrepareSettings>& setting = *find_setting<PrepareSettings>(key);
    const std::optional<int> count = setting.kind == SettingKind::integer ? whole_number<int>(value) : std::nullopt;
    // What is no count is refused as the number that it is.
    const std::string wrong = assign(settings, setting, count ? SettingValue(*count) : SettingValue(value));
    if (!wrong.empty()) throw ConfigurationError({"", option_name(setting), wrong, ""});
  }
}

SceneSurfaces read_input(const PrepareOptions& options) {
  if (options.files.size() == 1 && options.files.front().extension() == ".toml") {
    SceneSurfaces scene = read_scene_surfaces(options.files.front(), options.scene);
    set_given(scene.settings, options);
    return scene;
  }
  SceneSurfaces input;
  set_given(input.settings, options);
  const Real unit = unit_length(options.unit);
  std::vector<NamedSurface> muscles = read_surfaces(options.files, unit);
  input.bones = read_surfaces(options.bones, unit);
  require_sizes(muscles, options.files, unit);
  require_sizes(input.bones, options.bones, unit);
  input.muscles = rearranged(std::move(muscles), options, input.settings);
  return input;
}

/// What a run would refuse is not written.
void require_runnable(const std::vector<NamedSurface>& names, const std::vector<TriangleMesh>& muscles) {
  std::vector<Problem> problems;
  for (std::size_t m = 0; m < muscles.size(); ++m) try {
      check_surface(muscles[m], 1, SurfaceRole::muscle, names[m].name);
    } catch (const InputError& error) {
      for (const Problem& problem : error.problems())
        problems.push_back({problem.file, problem.where, problem.what + ", after preparation, too",
                            "try another --edge-length, or mend it in a mesh editor"});
    }
  if (!problems.empty()) throw InputError(std::move(problems));
}

int prepare(const PrepareOptions& options) {
  const SceneSurfaces input = read_input(options);
  const PreparedSurfaces prepared = prepare_surfaces(input.muscles, input.bones, input.settings, log_lines);
  require_runnable(input.muscles, prepared.muscles);
  std::error_code failed;
  fs::create_directories(options.out, failed);
  if (failed) throw InputError({options.out.string(), "", "cannot be made a folder: " + failed.message(), ""});
  std::set<std::string> names;
  for (std::size_t m = 0; m < input.muscles.size(); ++m)
    write_surface(options.out / (file_name_of(input.muscles[m].name, names) + ".vtp"), prepared.muscles[m].vertices,
                  prepared.muscles[m].faces);
  const std::string report = to_text(prepared.report);
  write_text_atomically(options.out / "report.txt", report);
  write_text_atomically(options.out / "report.json", to_json(prepared.report).dump(2) + "\n");
  fmt::print("{}{}\n", report, options.out.string());
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
  for (const Setting<PrepareSettings>& setting : setting_table<PrepareSettings>()) {
    const auto keep = [options, key = std::string(setting.key)](Real value) { options->settings[key] = value; };
    command->add_option_function<Real>(option_name(setting), keep,
                                       fmt::format("{} {}", setting.meaning, expectation(setting)));
  }
  command->callback([&chosen, options] { chosen = [options] { return prepare(*options); }; });
}

}  // namespace gracilis
