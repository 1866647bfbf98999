#include "view_command.hpp"

#include "console.hpp"
#include "handed_preparation.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/scene_place.hpp>
#include <gracilis/simulate/simulation.hpp>
#include <gracilis/view/pictures/run_picture.hpp>
#include <gracilis/view/window/interactive_window.hpp>
#include <gracilis/view/window/live_simulation.hpp>
#include <gracilis/view/window/run_loader.hpp>
#include <gracilis/view/window/slider_range.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <memory>
#include <sstream>

namespace gracilis {

namespace {

struct ViewOptions {
  std::string what, size = "1280x720", keys;
  SceneOptions scene;
  WindowOptions window;
};

void set_size(const std::string& text, WindowOptions& window) {
  char end = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &window.width, &window.height, &end) != 2 || window.width < 640 ||
      window.height < 480 || window.width > 8192 || window.height > 8192)
    throw ConfigurationError({"--size", "", "'" + text + "' is no size", "write WIDTHxHEIGHT, 640x480 or larger"});
}

void report(const WindowReport& report, bool benchmark) {
  std::string text = fmt::format("first picture after {:.2f} s", report.first_picture);
  if (report.pictures > 0 && report.playing > 0)
    text += fmt::format("; {:.1f} frames per second while playing, {:.1f} ms to draw one",
                        static_cast<Real>(report.pictures) / report.playing,
                        1000 * report.drawing / static_cast<Real>(report.pictures));
  if (benchmark)
    fmt::print("{}\n", text);
  else
    spdlog::info("{}", text);
}

void show(const ShownShapes& shapes, ShapeHistory& history, const WindowOptions& window,
          std::chrono::steady_clock::time_point begin) {
  const Real before = std::chrono::duration<Real>(std::chrono::steady_clock::now() - begin).count();
  WindowReport shown = show_window(shapes, history, window);
  shown.first_picture += before;
  report(shown, window.benchmark > 0);
}

/// Frames per second of a run, as it happened.
Real rate_of(const RecordedRun& run) {
  const Real seconds = run.times.empty() ? 0 : run.times.back() - run.times.front();
  return seconds > 0 ? static_cast<Real>(run.times.size() - 1) / seconds : 60;
}

void view_run(const ViewOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const RecordedRun run = open_recorded_run(options.what);
  ShapeHistory history;
  const RunLoader loader(run, history);
  WindowOptions window = options.window;
  window.expected_frames = run.frame_count;
  window.frames_per_second = rate_of(run);
  window.bone_fields = [&loader] {
    static constexpr Real cell_size = 0.0015, around = 0.02;  // m; for the eye
    std::vector<DistanceField> fields;
    for (const TriangleMesh& bone : loader.bones())
      fields.push_back(build_distance_field(bone, domain_by_cell_size(bone, cell_size, around)));
    return fields;
  };
  show(loader.shapes(), history, window, begin);
}

/// A slider for each coordinate within its range, and one for each muscle's activation.
std::vector<WindowSlider> sliders_of(const Scene& scene, LiveSimulation& simulation) {
  std::vector<WindowSlider> sliders;
  std::size_t number = 0;
  for (const Joint& joint : scene.joints) {
    for (const JointAxis& axis : joint.axes) {
      const Real unit = axis.translation ? 0.001 : radians(1);
      const auto [least, most] = slider_range(axis);
      sliders.push_back({"joints", axis.coordinate, axis.translation ? " mm" : "°", least / unit, most / unit,
                         [&simulation, number, unit] { return simulation.aim_of(number) / unit; },
                         [&simulation, number, unit](Real value) { simulation.aim(number, value * unit); }});
      ++number;
    }
  }
  for (std::size_t m = 0; m < scene.muscles.size(); ++m)
    sliders.push_back({"activation", scene.muscles[m].name, "", 0, 1,
                       [&simulation, m] { return simulation.activation_of(m); },
                       [&simulation, m](Real value) { simulation.activate(m, value); }});
  return sliders;
}

LiveControls controls_of(const Scene& scene, LiveSimulation& simulation) {
  LiveControls controls;
  controls.sliders = sliders_of(scene, simulation);
  controls.pause = [&simulation](bool on) { simulation.pause(on); };
  controls.is_paused = [&simulation] { return simulation.is_paused(); };
  controls.step = [&simulation] { simulation.step_once(); };
  controls.play_motion = [&simulation] { simulation.play_motion(); };
  controls.reset = [&simulation] { simulation.reset(); };
  controls.look_again = [&simulation] { simulation.look_again(); };
  controls.pull = [&simulation](std::size_t bone, const Vec3& point, const Vec3& target, const Vec3& looking) {
    return simulation.pull(bone, point, target, looking);
  };
  controls.status = [&simulation] { return simulation.status(); };
  return controls;
}

void view_scene(Scene scene, const ViewOptions& options, std::chrono::steady_clock::time_point begin) {
  static constexpr int kept_frames = 1500;
  const Vec3 place = place_of(scene);
  scene = shifted(std::move(scene), -place);  // what is drawn is single precision
  drive_all(scene);
  ShapeHistory history(kept_frames);
  LiveSimulation simulation(scene, history, [&scene] {
    return make_method(scene,
                       [&scene](const DistanceFieldSettings& settings) { return cached_bone_fields(scene, settings); });
  });
  WindowOptions window = options.window;
  window.live = controls_of(scene, simulation);
  window.bone_fields = [&scene] { return cached_bone_fields(scene); };
  show(simulation.shapes(), history, window, begin);
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

int view(ViewOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  set_size(options.size, options.window);
  options.window.keys = words(options.keys);
  require_display();
  // What a file manager opens of a run.
  if (const std::filesystem::path file = options.what; file.filename() == "run.json")
    options.what = folder_of(file).string();
  if (std::filesystem::is_directory(options.what)) {
    view_run(options);
  } else {
    const LoadedScene loaded = load_scene(options.what, options.scene);
    for (const std::string& warning : loaded.warnings) spdlog::warn("{}", warning);
    view_scene(loaded.scene, options, begin);
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_view_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<ViewOptions>();
  options->scene.prepare = scene_preparation();
  options->scene.say = log_lines;
  CLI::App* command = program.add_subcommand("view", "Look at a run, or move a scene, in a window");
  command
      ->add_option("WHAT", options->what,
                   "A run folder or its run.json, a scene file, demo for the built-in hip, or demo-elbow")
      ->required();
  command->add_option("--view", options->window.view, "From where at first (lateral)")
      ->check(CLI::IsMember(view_names()));
  command->add_option("--size", options->size, "WIDTHxHEIGHT of the window (1280x720)");
  command->add_option("--pictures", options->window.pictures, "Folder that the key p writes pictures to (here)");
  command->add_option("--keys", options->keys,
                      "Keys to press, by their names in X, such as 'End c p q': each as soon as nothing is still to "
                      "come; after 2s: in 2 seconds");
  command
      ->add_option("--benchmark", options->window.benchmark,
                   "Plays a run as fast as it can for so many seconds, prints the frame rate and closes")
      ->check(CLI::Range(0.1, 3600.0));
  command->add_option("--data", options->scene.data, "Folder with the scene's files");
  command->add_option("--set", options->scene.set, "Settings of a scene, as in 'gracilis run'")
      ->allow_extra_args(false);
  command->add_option("--only", options->scene.only, "Keep these muscles of a scene; names separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->callback([&chosen, options] { chosen = [options] { return view(*options); }; });
}

}  // namespace gracilis
