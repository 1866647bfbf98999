#include "scene_command.hpp"

#include "draft_output.hpp"
#include "handed_preparation.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/core/shell_word.hpp>
#include <gracilis/io/input_file.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>

namespace gracilis {

namespace fs = std::filesystem;

namespace {

struct SceneCommandOptions {
  fs::path folder, out, picture;
  std::vector<std::string> joints;
  bool force = false, mirror = false, prepare = false, json = false;
};

/// "knee_r=R_Med_Epi,R_Lat_Epi" as a joint and its landmarks.
void add_joint_landmarks(const std::string& text, DraftOptions& draft) {
  const std::size_t equals = text.find('=');
  std::vector<std::string> names;
  if (equals != std::string::npos) {
    std::size_t begin = equals + 1;
    for (std::size_t comma; (comma = text.find(',', begin)) != std::string::npos; begin = comma + 1)
      names.push_back(text.substr(begin, comma - begin));
    names.push_back(text.substr(begin));
  }
  const bool whole =
      !names.empty() && std::none_of(names.begin(), names.end(), [](auto& name) { return name.empty(); });
  if (!whole || names.size() > 2)
    throw ConfigurationError({"--joint", "", "'" + text + "' names no joint with one or two landmarks",
                              "write JOINT=CENTER or JOINT=ONE_SIDE,OTHER_SIDE, as in knee_r=R_Med_Epi,R_Lat_Epi"});
  draft.joint_landmarks[text.substr(0, equals)] = names;
}

int make_scene(const SceneCommandOptions& options) {
  if (is_there(options.folder / "run.json"))
    throw ConfigurationError({options.folder.string(), "", "is the folder of a run, not of bones and muscles",
                              run_folder_advice(options.folder)});
  require_new_scene(options.out, options.force);
  DraftOptions draft_options;
  draft_options.mirror = options.mirror;
  if (options.prepare) {
    draft_options.mend = surface_mending();
    draft_options.mended_folder = mended_folder(options.out);
  }
  for (const std::string& joint : options.joints) add_joint_landmarks(joint, draft_options);
  const SceneDraft draft = draft_scene(options.folder, draft_options);

  const fs::path beside = fs::path(options.out).replace_extension(".png");
  write_and_show(draft, options.out, options.picture.empty() ? beside : options.picture, options.json);
  if (!options.json)
    spdlog::info("next: gracilis run {} --out {}", shell_word(options.out.string()),
                 shell_word(fs::path(options.out).replace_extension("").string()));
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_scene_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<SceneCommandOptions>();
  CLI::App* command = program.add_subcommand(
      "scene", "Make a scene of a folder of surfaces: bones, joints, muscles and where they attach, each guess marked");
  command->add_option("FOLDER", options->folder, "Folder with surfaces of bones and muscles, named after them")
      ->required();
  command->add_option("--out", options->out, "Scene file to write (.toml)")->required();
  command
      ->add_option("--joint", options->joints,
                   "JOINT=CENTER or JOINT=ONE,OTHER: landmarks (of a .csv in the folder) that say where a joint is")
      ->allow_extra_args(false);
  command->add_option("--picture", options->picture,
                      "Where to draw what was guessed (.png; default: beside the scene file)");
  command->add_flag(
      "--prepare", options->prepare,
      "Mend muscles' surfaces that a run would refuse, that cut themselves or that have pieces in others; "
      "they are written into a folder beside the scene");
  command->add_flag("--mirror", options->mirror, "Make the body's other half: a left leg of a right one");
  command->add_flag("--force", options->force, "Replace the scene file");
  command->add_flag("--json", options->json, "Print what was found and guessed as JSON, for programs");
  command->callback([&chosen, options] { chosen = [options] { return make_scene(*options); }; });
}

}  // namespace gracilis
