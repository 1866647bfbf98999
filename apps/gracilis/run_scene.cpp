#include "run_scene.hpp"

#include "demo_command.hpp"
#include "scene_options.hpp"
#include "session.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/run/run_manifest.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace gracilis {

LoadedScene scene_of_run(const std::filesystem::path& run) {
  std::vector<std::string> words = read_manifest(run).value("command", std::vector<std::string>{});
  const std::string command = words.size() < 2 ? "" : words[1];
  const bool is_demo = command == "demo";
  if (!is_demo && (words.size() < 3 || (command != "run" && command != "rom")))
    throw ConfigurationError({run.string(), "", "the run was not made of a scene file", "run a scene file"});
  CLI::App parser;
  std::filesystem::path file;
  SceneOptions options;
  DemoOptions demo;
  // So that no value of other options is taken for the scene.
  SessionOptions session;
  std::vector<std::string> of_rom;
  if (is_demo) {
    add_demo_options(parser, demo, options);
  } else {
    add_scene_options(parser, file, options);
  }
  add_session_options(parser, session);
  for (const char* option : {"--coord", "--reference"}) parser.add_option(option, of_rom)->allow_extra_args(false);
  parser.allow_extras();
  words.erase(words.begin(), words.begin() + 2);
  std::reverse(words.begin(), words.end());
  try {
    parser.parse(words);
  } catch (const CLI::ParseError& error) {
    throw InputError({(run / "run.json").string(), "command", std::string("is damaged: ") + error.what(),
                      "run the scene again"});
  }
  return is_demo ? load_demo(demo, options) : read_scene(file, options);
}

}  // namespace gracilis
