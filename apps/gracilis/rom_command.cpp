#include "rom_command.hpp"

#include "moment_arm_output.hpp"
#include "scene_options.hpp"
#include "session.hpp"

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/tables/arm_reference.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/scene/motion.hpp>
#include <gracilis/scene/names.hpp>
#include <gracilis/simulate/moment_arm_curves.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace gracilis {

namespace {

/// What --coord says: a coordinate that goes from one value to another, or stays at one. Degrees, or mm where the
/// coordinate is a translation.
struct CoordinateRange {
  std::string name;
  Real from = 0, to = 0, step = 0;
  bool translation = false;

  /// Of one degree or mm, in rad or m.
  Real unit() const { return translation ? 0.001 : radians(1); }

  bool moves() const { return step != 0; }
};

CoordinateRange parse_range(const std::string& text) {
  const auto wrong = [&](const std::string& what) {
    return ConfigurationError({"--coord", "", "'" + text + "' " + what,
                               "write NAME=FROM:TO:STEP or NAME=VALUE, in degrees, or mm for a translation"});
  };
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw wrong("names no coordinate");
  std::vector<Real> numbers;
  for (std::size_t begin = equals + 1; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    double value = 0;
    if (!parse_number(std::string_view(text).substr(begin, end - begin), value) || !std::isfinite(value))
      throw wrong("holds something that is no number");
    numbers.push_back(value);
    begin = end + 1;
  }
  CoordinateRange range{text.substr(0, equals), numbers[0], numbers[0], 0};
  if (numbers.size() == 1) return range;
  if (numbers.size() != 3) throw wrong("has " + std::to_string(numbers.size()) + " numbers");
  range.to = numbers[1];
  range.step = numbers[2];
  if (!(range.step > 0) || range.from == range.to) throw wrong("goes nowhere");
  return range;
}

const JointAxis& axis_of(const Scene& scene, const std::string& coordinate) {
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes)
      if (axis.coordinate == coordinate) return axis;
  throw ConfigurationError(
      {"--coord", "", "there is no coordinate '" + coordinate + "'", suggestion(coordinate, coordinate_names(scene))});
}

/// The scene's motion becomes: from the range's begin to its end; coordinates that are not named keep their capture
/// value. Returns the coordinate that moves.
CoordinateRange set_motion(const std::vector<std::string>& texts, int max_frames, Scene& scene) {
  std::vector<std::string> names;
  Eigen::MatrixXd keys(2, static_cast<Index>(texts.size()));
  CoordinateRange moving;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    CoordinateRange range = parse_range(texts[i]);
    range.translation = axis_of(scene, range.name).translation;
    if (std::find(names.begin(), names.end(), range.name) != names.end())
      throw ConfigurationError({"--coord", "", "the coordinate '" + range.name + "' is given twice", ""});
    if (range.moves() && moving.moves())
      throw ConfigurationError({"--coord", "", "two coordinates move", "let one move and give the others one value"});
    if (range.moves()) moving = range;
    names.push_back(range.name);
    keys.col(static_cast<Index>(i)) << range.from * range.unit(), range.to * range.unit();
  }
  if (!moving.moves())
    throw ConfigurationError({"--coord", "", "no coordinate moves", "write one as NAME=FROM:TO:STEP"});
  set_range(scene, motion_through(names, keys, moving.step * moving.unit(), 1.0 / 60, max_frames));
  return moving;
}

/// The coordinate that moves; empty where none does.
std::string moving_name(const std::vector<std::string>& texts) {
  for (const std::string& text : texts)
    if (const CoordinateRange range = parse_range(text); range.moves()) return range.name;
  return "";
}

}  // namespace

void add_rom_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen) {
  struct Options {
    std::filesystem::path file;
    SceneOptions scene;
    std::vector<std::string> coordinates;
    std::filesystem::path reference;
    SessionOptions session;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("rom", "Run through a joint's range of motion; writes moment arms, too");
  add_scene_options(*command, options->file, options->scene);
  command
      ->add_option("--coord", options->coordinates,
                   "NAME=FROM:TO:STEP in degrees, as in hip_flexion_r=-10:60:2, or in mm where the coordinate is a "
                   "translation; NAME=VALUE fixes another coordinate. May be repeated")
      ->required()
      ->allow_extra_args(false);
  command->add_option(
      "--reference", options->reference,
      "Published moment arms to compare with and to draw: a .csv with the columns muscle, angle_deg and "
      "moment_arm_mm, and perhaps coordinate, source, min and max; or a moment_arms.sto of another 'rom'");
  add_session_options(*command, options->session);
  options->session.command = words;
  command->callback([&chosen, options] {
    chosen = [options] {
      std::vector<ArmCurve> references;
      if (!options->reference.empty())
        references = read_arm_reference(options->reference, moving_name(options->coordinates));
      LoadedScene loaded = read_scene(options->file, options->scene);
      if (options->session.out.empty())
        options->session.out = std::filesystem::path("runs") / (file_name_of(loaded.scene.name) + "_rom");
      const CoordinateRange moving = set_motion(options->coordinates, loaded.max_frames, loaded.scene);
      options->session.fiber_actions = true;
      const int code = run_session(loaded, options->session);
      if (code != static_cast<int>(ExitCode::interrupted))
        write_moment_arms(options->session.out, loaded.scene, {moving.name, moving.translation}, references);
      return code;
    };
  });
}

}  // namespace gracilis
