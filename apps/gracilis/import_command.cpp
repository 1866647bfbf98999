#include "import_command.hpp"

#include "opensim_model.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/opensim/scene_folder.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace gracilis {

namespace {

namespace fs = std::filesystem;

struct ImportOptions {
  fs::path model, out, map;
  std::vector<fs::path> geometry, motions;
  opensim::SceneFolderSettings settings;
  bool strict = false;
};

/// The motions given; without one, the pose of the default coordinates.
std::vector<opensim::NamedMotion> motions_of(const opensim::Model& model, const ImportOptions& options) {
  std::vector<opensim::NamedMotion> motions;
  for (const fs::path& path : options.motions) {
    const Table table = read_table(path);
    for (const std::string& warning : table.warnings) spdlog::warn("{}", warning);
    motions.push_back({path.stem().string(), opensim::coordinate_motion(model, table)});
    for (const std::string& note : motions.back().motion.notes) spdlog::warn("{}", note);
  }
  if (motions.empty()) motions.push_back({"rest", {{0}, opensim::default_coordinates(model).transpose(), {}}});
  return motions;
}

int import_model(const ImportOptions& options) {
  const opensim::Model model = read_opensim_model(options.model, options.strict);
  opensim::GeometryPlaces places{options.model.parent_path(), options.geometry, {}};
  if (!options.map.empty()) places.named = opensim::read_geometry_map(options.map);
  if (fs::exists(options.out / "model.toml"))
    throw ConfigurationError({options.out.string(), "", "holds a model already", "name another folder with --out"});
  const std::vector<opensim::NamedMotion> motions = motions_of(model, options);
  const std::vector<std::string> left_out =
      opensim::write_scene_folder(model, places, motions, options.settings, options.out);
  for (const std::string& line : left_out) spdlog::warn("{}", line);
  for (const opensim::NamedMotion& motion : motions)
    fmt::print("{}\n", (options.out / (motion.name + ".toml")).string());
  if (options.strict && !left_out.empty())
    throw Error(ExitCode::unsupported, fmt::format("{} elements were left out (--strict)", left_out.size()));
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_import_command(CLI::App& program, Command& chosen) {
  CLI::App* command =
      program.add_subcommand("import", "Make a scene of bones, joints and volumetric muscles of an OpenSim model");
  const auto options = std::make_shared<ImportOptions>();
  command->add_option("MODEL", options->model, "OpenSim model (.osim)")->required();
  command->add_option("--geometry", options->geometry, "Folder of the bones' surfaces; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--map", options->map, "TOML file: \"name in the model\" = [\"file\", ...], with units");
  command->add_option("--motion", options->motions, "Motion to make a scene for (.mot, .sto); may be repeated")
      ->allow_extra_args(false);
  command->add_option("--muscles", options->settings.muscles, "Muscles to take, between commas (default: all)")
      ->delimiter(',');
  command->add_option("--rays", options->settings.volumes.rays, "Corners of a muscle's cross-section, 6 or more")
      ->check(CLI::Range(6, 100))
      ->capture_default_str();
  command
      ->add_option("--specific-tension", options->settings.volumes.specific_tension,
                   "Force per physiological cross-section area, N/m²")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder for the scene")->required();
  command->add_flag("--strict", options->strict, "Fail where something is left out (exit code 4)");
  command->callback([&chosen, options] { chosen = [options] { return import_model(*options); }; });
}

}  // namespace gracilis
