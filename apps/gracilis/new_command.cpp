#include "new_command.hpp"

#include "draft_output.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/core/shell_word.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/mesh/likely_unit.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <optional>

namespace gracilis {

namespace {

namespace fs = std::filesystem;

struct NewOptions {
  std::vector<fs::path> files, bones;
  fs::path out = "scene.toml";
  std::string unit;
  bool force = false, json = false;
};

void require_surfaces(const NewOptions& options) {
  std::vector<Problem> problems;
  for (const std::vector<fs::path>* files : {&options.files, &options.bones})
    for (const fs::path& file : *files) {
      std::error_code ignored;
      if (fs::is_directory(file, ignored))
        problems.push_back(
            {file.string(), "", "is a folder",
             "name its surfaces, or: gracilis scene " + shell_word(file.string()) + " --out scene.toml"});
      else if (!is_there(file))
        problems.push_back({file.string(), "", "is not there", ""});
    }
  if (!problems.empty()) throw InputError(problems);
}

/// How long the longest surface is, in the files' unit.
Real longest_extent(const FolderFiles& files) {
  Real longest = 0;
  for (const NamedSurfaceFile& each : files.surfaces) {
    const Points points = files.meshes->read(each.file, 1, each.part).vertices;
    if (points.cols() > 0) longest = std::max(longest, bounding_box(points).sizes().maxCoeff());
  }
  return longest;
}

/// In the unit that is given, or by the sizes of known bones, or else by that of all surfaces, which is told.
SceneDraft drafted_with_gaps(const FolderFiles& files, const NewOptions& options) {
  if (!options.unit.empty()) return draft_without_joints(files, {.unit = options.unit});
  const bool knows_bones = std::any_of(files.surfaces.begin(), files.surfaces.end(), is_surely_a_bone);
  if (knows_bones) {
    SceneDraft draft = draft_without_joints(files, {});
    spdlog::warn("the files are taken to be in {}, by the bones' sizes; --unit says another one", draft.found.unit);
    return draft;
  }
  const Real longest = longest_extent(files);
  const LengthUnit unit = likely_unit(longest);
  spdlog::warn("the files are taken to be in {}: the longest surface is then {:.3g} cm long; --unit says another one",
               unit.name, 100 * unit.length * longest);
  return draft_without_joints(files, {.unit = unit.name});
}

/// What keeps the files from being drafted as a whole; nothing where they were.
std::vector<Problem> drafted(const FolderFiles& files, const NewOptions& options, std::optional<SceneDraft>& draft) {
  try {
    draft = draft_scene(files, "the list of surfaces", {.unit = options.unit});
    return {};
  } catch (const InputError& error) {
    return error.problems();
  }
}

void write_whole(const SceneDraft& draft, const NewOptions& options) {
  const fs::path& out = options.out;
  write_and_show(draft, out, fs::path(out).replace_extension(".png"), options.json);
  if (options.json) return;
  fmt::print("next: gracilis run {} --out {}\n", shell_word(out.string()),
             shell_word(fs::path(out).replace_extension("").string()));
}

/// A scene that does not run yet: what is in it, and why there is not more.
void print_gaps(const SceneDraft& draft, const fs::path& out, const std::vector<Problem>& why) {
  nlohmann::ordered_json problems = nlohmann::json::array();
  for (const Problem& problem : why) problems.push_back(to_string(problem));
  fmt::print("{}", json_text({{"scene", out.string()},
                              {"bones", draft.found.bones.size()},
                              {"muscles", draft.found.muscles.size()},
                              {"left_out", draft.left_out},
                              {"missing", problems}}));
}

void write_with_gaps(const FolderFiles& files, const NewOptions& options, const std::vector<Problem>& why) {
  const SceneDraft draft = drafted_with_gaps(files, options);
  if (draft.found.bones.empty() && draft.found.muscles.empty()) {
    std::vector<Problem> problems;
    for (const std::string& line : draft.left_out) problems.push_back({"", "", line, ""});
    throw InputError(problems);
  }
  write_draft_files(draft, options.out);
  if (!options.json) tell(draft);
  for (const Problem& problem : why) spdlog::warn("{}", to_string(problem));
  if (options.json) return print_gaps(draft, options.out, why);
  fmt::print("missing: joints, where muscles are held, a motion; fill them in where {} says '# missing:'\n{}\n",
             options.out.string(), options.out.string());
  fmt::print("next: gracilis inspect {}\n", shell_word(options.out.string()));
}

int write_new_scene(const NewOptions& options) {
  require_new_scene(options.out, options.force);
  require_surfaces(options);
  const FolderFiles files = list_files(options.files, options.bones);
  std::optional<SceneDraft> draft;
  const std::vector<Problem> why = drafted(files, options, draft);
  if (draft)
    write_whole(*draft, options);
  else
    write_with_gaps(files, options, why);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_new_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<NewOptions>();
  CLI::App* command = program.add_subcommand(
      "new", "Write a commented scene of surfaces, told apart by their names, which runs or says what is missing");
  command->add_option("FILES", options->files, "Surfaces of bones and muscles (.ply .stl .obj .vtk .vtp)")->required();
  command->add_option("--bone", options->bones, "Surfaces of bones, whatever they are called");
  command->add_option("--unit", options->unit, "Unit of the files: m, cm or mm (default: by the bones' sizes)")
      ->check(CLI::IsMember({"m", "cm", "mm"}));
  command->add_option("--out", options->out, "Scene file to write (default: scene.toml)");
  command->add_flag("--force", options->force, "Replace the scene file");
  command->add_flag("--json", options->json, "Print what was found, guessed or missing as JSON, for programs");
  command->callback([&chosen, options] { chosen = [options] { return write_new_scene(*options); }; });
}

}  // namespace gracilis
