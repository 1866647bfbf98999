#include "run_scene.hpp"

#include "scene_options.hpp"
#include "session.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/run/run_manifest.hpp>
#include <gracilis/io/scene/demo_scene.hpp>

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
  SessionOptions session;  // so that no value of these is taken for the scene
  if (is_demo) {
    parser.add_option("SCENE", demo.scene);
    parser.add_option("--preset", demo.preset);
    parser.add_option("--contact", demo.contact);
    parser.add_option("--flexion", demo.flexion_deg);
    parser.add_option("--step", demo.step_deg);
    add_setting_options(parser, options);
  } else {
    add_scene_options(parser, file, options);
  }
  add_session_options(parser, session);
  parser.allow_extras();
  words.erase(words.begin(), words.begin() + 2);
  std::reverse(words.begin(), words.end());
  parser.parse(words);
  return is_demo ? load_demo(demo, options) : read_scene(file, options);
}

}  // namespace gracilis
