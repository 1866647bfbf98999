#include "prepare_command.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/core/whole_number.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/io/scene/preparation_report.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/scene/names.hpp>
#include <gracilis/scene/setting_table.hpp>

#ifdef GRACILIS_WITH_PREPARE
#include <gracilis/prepare/prepare_surfaces.hpp>
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
  bool merge = false, split = false;
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

/// One surface of all, or one of each piece, as asked for.
std::vector<NamedSurface> rearranged(std::vector<NamedSurface> surfaces, const PrepareOptions& options) {
  if (options.merge) {
    std::vector<TriangleMesh> meshes;
    for (NamedSurface& surface : surfaces) meshes.push_back(std::move(surface.mesh));
    surfaces = {{"merged", merged(meshes)}};
  }
  if (!options.split) return surfaces;
  std::vector<NamedSurface> pieces;
  for (const NamedSurface& surface : surfaces) {
    int number = 0;
    for (TriangleMesh& piece : pieces_of(surface.mesh))
      pieces.push_back({fmt::format("{}_{}", surface.name, ++number), std::move(piece)});
  }
  return pieces;
}

SceneSurfaces read_input(const PrepareOptions& options) {
  if (options.files.size() == 1 && options.files.front().extension() == ".toml")
    return read_scene_surfaces(options.files.front(), options.scene);
  const Real unit = unit_length(options.unit);
  return {"", rearranged(read_surfaces(options.files, unit), options), read_surfaces(options.bones, unit), {}};
}

int prepare(const PrepareOptions& options) {
  SceneSurfaces input = read_input(options);
  for (const auto& [key, value] : options.settings) {
    const Setting<PrepareSettings>& setting = *find_setting<PrepareSettings>(key);
    const std::optional<int> count =
        setting.kind == SettingKind::integer ? whole_number<int>(value) : std::nullopt;
    // What is no count is refused as the number that it is.
    const std::string wrong = assign(input.settings, setting, count ? SettingValue(*count) : SettingValue(value));
    if (!wrong.empty()) throw ConfigurationError({"", option_name(setting), wrong, ""});
  }
  const PreparedSurfaces prepared = prepare_surfaces(input.muscles, input.bones, input.settings, log_lines);
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

void add_prepare_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<PrepareOptions>();
  CLI::App* command = program.add_subcommand(
      "prepare", "Repair surfaces, remesh them and pull overlaps apart; writes .vtp in metres and a report");
  command->add_option("FILE", options->files, "Surfaces of muscles, or one scene file")->required();
  command->add_option("--out", options->out, "Folder to write")->required();
  command->add_option("--bone", options->bones, "Surfaces that stay as they are and that muscles keep out of")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--unit", options->unit, "Unit of the files (not of a scene): m, cm or mm")
      ->check(CLI::IsMember({"m", "cm", "mm"}));
  command->add_flag("--merge", options->merge, "Make one surface of all files");
  command->add_flag("--split", options->split, "Make a surface of each connected piece");
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
