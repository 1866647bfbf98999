#include "import_command.hpp"

#include "opensim_model.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/core/shell_word.hpp>
#include <gracilis/io/counted.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/opensim/import/scene_folder.hpp>
#include <gracilis/opensim/import/scene_joints.hpp>
#include <gracilis/opensim/import/skeleton_fit.hpp>
#include <gracilis/opensim/kinematics/skeleton.hpp>
#include <gracilis/scene/names.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <set>

namespace gracilis {

namespace {

namespace fs = std::filesystem;

struct ImportOptions {
  fs::path model, out, map, surfaces, fit;
  std::vector<fs::path> geometry, motions;
  std::vector<std::string> pose;
  opensim::SceneFolderSettings settings;
  bool strict = false, json = false;
};

/// The motions given; without one, the pose of the default coordinates.
std::vector<opensim::NamedMotion> motions_of(const opensim::Model& model, const ImportOptions& options) {
  std::vector<opensim::NamedMotion> motions;
  std::set<std::string> names = {"model"};
  for (const fs::path& path : options.motions) {
    const Table table = read_table(path);
    for (const std::string& warning : table.warnings) spdlog::warn("{}", warning);
    motions.push_back({file_name_of(path.stem().string(), names), opensim::coordinate_motion(model, table)});
    for (const std::string& note : motions.back().motion.notes) spdlog::warn("{}", note);
  }
  if (motions.empty()) motions.push_back({"rest", {{0}, opensim::default_coordinates(model).transpose(), {}}});
  return motions;
}

/// "hip_flexion_r=30", in degrees or m: the values become the coordinates' defaults.
void set_pose(opensim::Model& model, const std::vector<std::string>& pose) {
  std::vector<bool> held(model.coordinates.size(), false);
  for (const std::string& setting : pose) {
    const std::size_t equals = setting.find('=');
    double number = 0;
    if (equals == std::string::npos || !parse_number(setting.substr(equals + 1), number))
      throw ConfigurationError({"--pose", "", fmt::format("'{}' is not of the form NAME=VALUE", setting), ""});
    const std::string name = setting.substr(0, equals);
    const Index index = opensim::index_of(model.coordinates, name);
    if (index < 0)
      throw ConfigurationError({"--pose", "", fmt::format("the model has no coordinate '{}'", name),
                                suggestion(name, opensim::names_of(model.coordinates))});
    opensim::Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(index)];
    coordinate.default_value = number * (coordinate.rotation ? radians(1) : 1);
    held[static_cast<std::size_t>(index)] = true;
  }
  if (!pose.empty()) close_default_pose(model, held);
}

/// Surfaces of muscles, from a file as --map has it, for the pose of the default coordinates.
std::map<std::string, TriangleMesh> muscle_surfaces(const opensim::Model& model, const fs::path& path) {
  opensim::Skeleton skeleton(model);
  skeleton.place(opensim::default_coordinates(model));
  return opensim::load_muscle_surfaces(model, skeleton.poses(), opensim::read_geometry_map(path));
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// What was made of the model, and what to do with it.
void say_next(const opensim::Model& model, const std::vector<opensim::NamedMotion>& motions, const fs::path& folder) {
  spdlog::info("{}: {}, {}, {}", folder.string(), counted(files_in(folder / "muscles"), "muscle"),
               counted(files_in(folder / "bones"), "bone"), counted(model.coordinates.size(), "coordinate"));
  for (const opensim::NamedMotion& motion : motions) {
    const fs::path scene = opensim::scene_file(folder, motion);
    const std::size_t rows = motion.motion.times.size();
    const int kept = opensim::kept_rows(motion);
    if (static_cast<std::size_t>(kept) < rows)
      spdlog::info("{}: of {} rows {} are taken, {} s apart; `time_step` in {} says so", motion.name, rows, kept,
                   opensim::imported_time_step, scene.string());
    spdlog::info("next: gracilis run {} --out {}", shell_word(scene.string()),
                 shell_word("runs/" + scene.stem().string()));
  }
}

void print_json(const opensim::Model& model, const std::vector<std::string>& scenes, const fs::path& folder,
                const opensim::SceneFolderNotes& notes) {
  fmt::print("{}", json_text({{"scenes", scenes},
                              {"muscles", files_in(folder / "muscles")},
                              {"bones", files_in(folder / "bones")},
                              {"coordinates", model.coordinates.size()},
                              {"sheets", notes.sheets},
                              {"left_out", notes.left_out}}));
}

/// Reads the scenes as a run will. What it would refuse is taken back: throws what is wrong with it.
void check_scenes(const ImportOptions& options, const opensim::Model& model,
                  const std::vector<opensim::NamedMotion>& motions) {
  const fs::path& folder = options.out;
  try {
    if (files_in(folder / "muscles") == 0)
      throw InputError({options.model.string(), "", "no muscle is left of it", "so there is nothing to run"});
    if (std::all_of(model.joints.begin(), model.joints.end(),
                    [&](const opensim::Joint& joint) { return opensim::scene_axes(model, joint).empty(); }))
      throw InputError({options.model.string(), "", "no coordinate of it moves a body", "so there is nothing to run"});
    for (const opensim::NamedMotion& motion : motions) read_scene(opensim::scene_file(folder, motion));
  } catch (const Error&) {
    for (const opensim::NamedMotion& motion : motions) fs::remove(opensim::scene_file(folder, motion));
    fs::remove(folder / "model.toml");
    spdlog::warn("{}: no scene that runs comes of it", options.model.string());
    throw;
  }
}

int import_model(ImportOptions options) {
  opensim::Model model = read_opensim_model(options.model, options.strict);
  set_pose(model, options.pose);
  if (!options.fit.empty()) model = opensim::fit_to_skeleton(model, opensim::read_skeleton_fit(options.fit));
  if (options.settings.volumes.rays % 2 != 0)
    throw ConfigurationError(
        {"--rays", "", fmt::format("{} is odd", options.settings.volumes.rays), "give an even number"});
  if (!options.surfaces.empty()) options.settings.volumes.surfaces = muscle_surfaces(model, options.surfaces);
  opensim::GeometryPlaces places{options.model.parent_path(), options.geometry, {}};
  if (!options.map.empty()) places.named = opensim::read_geometry_map(options.map);
  if (fs::exists(options.out / "model.toml"))
    throw ConfigurationError(
        {options.out.string(), "", "holds a model already", "name another folder with --out, or remove this one"});
  const std::vector<opensim::NamedMotion> motions = motions_of(model, options);
  const opensim::SceneFolderNotes notes =
      opensim::write_scene_folder(model, places, motions, options.settings, options.out);
  for (const std::string& line : notes.left_out) spdlog::warn("{}", line);
  for (const std::string& line : notes.sheets) spdlog::info("{}", line);
  check_scenes(options, model, motions);
  std::vector<std::string> scenes;
  for (const opensim::NamedMotion& motion : motions)
    scenes.push_back(opensim::scene_file(options.out, motion).string());
  if (options.json)
    print_json(model, scenes, options.out, notes);
  else
    for (const std::string& scene : scenes) fmt::print("{}\n", scene);
  say_next(model, motions, options.out);
  if (options.strict && !notes.left_out.empty())
    throw Error(ExitCode::unsupported, fmt::format("{} elements were left out (--strict)", notes.left_out.size()));
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
  command
      ->add_option("--pose", options->pose,
                   "The pose of bones and surfaces, NAME=VALUE,... in degrees and m (default: the model's)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--fit", options->fit, "TOML file that says where the bodies lie in another skeleton");
  command->add_option("--surfaces", options->surfaces,
                      "TOML file as --map takes: \"muscle\" = its surface, { files, unit, like = \"bone's surface\" }; "
                      "sections are brought onto it");
  command
      ->add_option("--more-rays", options->settings.volumes.enhancement.more_rays,
                   "Times as many rays as corners look for the inside of such a surface")
      ->check(CLI::Range(1, 32))
      ->capture_default_str();
  static const std::map<std::string, bool> centers = {{"mended", true}, {"published", false}};
  command
      ->add_option("--centers", options->settings.volumes.enhancement.mend,
                   "Where sections of such a surface have their centers: inside, where there is an inside (mended, "
                   "default), or where Laclé's heuristic puts them (published)")
      ->transform(CLI::CheckedTransformer(centers));
  static const std::map<std::string, SectionPlanes> planes = {
      {"centered", SectionPlanes::centered}, {"forward", SectionPlanes::forward}, {"fixed", SectionPlanes::fixed}};
  command
      ->add_option("--planes", options->settings.volumes.enhancement.planes,
                   "Which way sections of such a surface look (Laclé 2014, Figure 3.9): by both neighbors of a point "
                   "(centered, default), by the next one (forward) or down, whatever the line does (fixed)")
      ->transform(CLI::CheckedTransformer(planes));
  static const std::map<std::string, opensim::TendonPlace> tendons = {
      {"belly", opensim::TendonPlace::beyond_belly},
      {"half", opensim::TendonPlace::half_at_insertion},
      {"whole", opensim::TendonPlace::whole_at_insertion},
      {"both-ends", opensim::TendonPlace::both_ends}};
  command
      ->add_option(
          "--tendon", options->settings.volumes.tendon,
          "What of the line is tendon: what a belly of published length leaves (belly, default), half of the tendon's "
          "slack length at the insertion (half), the whole, or half at both ends")
      ->transform(CLI::CheckedTransformer(tendons));
  command->add_option("--rays", options->settings.volumes.rays, "Corners of a muscle's cross-section, 6 or more")
      ->check(CLI::Range(6, 100))
      ->capture_default_str();
  command
      ->add_option_function<double>(
          "--section-distance-mm",
          [options](double distance) { options->settings.volumes.section_distance = distance / 1000; },
          "Sections divide a muscle's line evenly, at most so far apart (8), those of a sheet 1.5 times")
      ->check(CLI::Range(0.5, 1000.0));
  command
      ->add_option("--scaling", options->settings.volumes.scaling,
                   "Instead: how often each part between a line's points is halved, from 0")
      ->check(CLI::Range(0, 16))
      ->excludes("--section-distance-mm");
  command->add_flag("--tendon-sections", options->settings.volumes.tendon_sections,
                    "A section more where each tendon ends, between its neighbors in shape");
  command
      ->add_option("--specific-tension", options->settings.volumes.specific_tension,
                   "Force per physiological cross-section area, N/m²")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--apart", options->settings.apart,
                    "Muscles keep out of each other in that pose: they share the room that lines leave them");
  command->add_flag("--merge-heads", options->settings.merge_heads,
                    "Heads of one muscle (glut_max1_r, glut_max2_r ...) become one sheet over their lines");
  command->add_option("--out", options->out, "Folder for the scene")->required();
  command->add_flag("--strict", options->strict, "Fail where something is left out (exit code 4)");
  command->add_flag("--json", options->json, "Print the scenes and what was left out as JSON, for programs");
  command->callback([&chosen, options] { chosen = [options] { return import_model(*options); }; });
}

}  // namespace gracilis
