#include "motions_command.hpp"

#include "opensim_model.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/opensim/kinematics/sample_motions.hpp>
#include <gracilis/scene/names.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

namespace gracilis {

namespace {

namespace fs = std::filesystem;

struct MotionsOptions {
  fs::path model, out;
  std::vector<std::string> joints, ranges;
  Real speed_deg = 30;
  bool json = false;
  opensim::SampleSettings settings;
};

bool is_asked_for(const MotionsOptions& options, const opensim::Joint& joint) {
  const std::vector<std::string>& asked = options.joints;
  return asked.empty() || std::find(asked.begin(), asked.end(), joint.name) != asked.end();
}

/// A range of what is not sampled would be passed over without a word.
void require_sampled(const opensim::Model& model, Index index, const MotionsOptions& options) {
  const opensim::Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(index)];
  const auto fail = [&](const std::string& why, const std::string& remedy) {
    throw ConfigurationError({"--range", "", fmt::format("'{}' {}", coordinate.name, why), remedy});
  };
  if (!coordinate.rotation) fail("is no angle", "only angles are sampled");
  const bool is_dependent = std::any_of(model.couplers.begin(), model.couplers.end(),
                                        [&](const auto& coupler) { return coupler.dependent == index; });
  if (coordinate.locked || is_dependent)
    fail("is locked or depends on others, and is not sampled", "leave its range out");
  const opensim::Joint& joint = model.joints[static_cast<std::size_t>(coordinate.joint)];
  if (!is_asked_for(options, joint))
    fail(fmt::format("is a coordinate of the joint '{}', which --joint leaves out", joint.name),
         fmt::format("add --joint {}, or leave the range out", joint.name));
}

/// "hip_flexion_r=-10:60", in degrees.
void read_range(const opensim::Model& model, const std::string& text, const MotionsOptions& options,
                opensim::SampleSettings& settings) {
  const std::size_t equals = text.find('='), colon = text.find(':', equals + 1);
  double low = 0, high = 0;
  if (equals == std::string::npos || colon == std::string::npos ||
      !parse_number(text.substr(equals + 1, colon - equals - 1), low) || !parse_number(text.substr(colon + 1), high))
    throw ConfigurationError({"--range", "", fmt::format("'{}' is not of the form NAME=FROM:TO", text), ""});
  if (!std::isfinite(low) || !std::isfinite(high))
    throw ConfigurationError(
        {"--range", "", fmt::format("'{}' is no range", text), "FROM and TO are finite numbers of degrees"});
  const std::string name = text.substr(0, equals);
  const Index index = opensim::index_of(model.coordinates, name);
  if (index < 0)
    throw ConfigurationError({"--range", "", fmt::format("the model has no coordinate '{}'", name),
                              suggestion(name, opensim::names_of(model.coordinates))});
  require_sampled(model, index, options);
  settings.ranges[name] = {radians(low), radians(high)};
}

int write_motions(const MotionsOptions& options) {
  const opensim::Model model = read_opensim_model(options.model, false);
  opensim::SampleSettings settings = options.settings;
  settings.speed = radians(options.speed_deg);
  std::vector<std::string> known;
  for (const opensim::Joint& joint : model.joints) known.push_back(joint.name);
  for (const std::string& name : options.joints)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw ConfigurationError(
          {"--joint", "", fmt::format("the model has no joint '{}'", name), suggestion(name, known)});
  for (const std::string& range : options.ranges) read_range(model, range, options, settings);
  fs::create_directories(options.out);
  std::set<std::string> taken;
  nlohmann::ordered_json told = nlohmann::json::array();
  for (const opensim::Joint& joint : model.joints) {
    if (!is_asked_for(options, joint)) continue;
    for (const opensim::SampleMotion& sample : opensim::sample_motions(model, joint, settings)) {
      const fs::path path = options.out / (file_name_of(sample.name, taken) + ".mot");
      write_sto(path, opensim::coordinate_table(model, sample.motion));
      told.push_back({{"file", path.string()}, {"joint", joint.name}, {"rows", sample.motion.times.size()}});
      if (!options.json) fmt::print("{}\n", path.string());
    }
  }
  if (options.json) fmt::print("{}", json_text({{"motions", told}}));
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_motions_command(CLI::App& program, Command& chosen) {
  CLI::App* command =
      program.add_subcommand("motions", "Sample motions that fill the space of an OpenSim model's joints");
  const auto options = std::make_shared<MotionsOptions>();
  command->add_option("MODEL", options->model, "OpenSim model (.osim)")->required();
  command->add_option("--joint", options->joints, "Joint; may be repeated (default: all)")->allow_extra_args(false);
  command->add_option("--steps", options->settings.steps, "Steps from one end of a coordinate's range to the other")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--range", options->ranges,
                   "NAME=FROM:TO in degrees: a coordinate's range (default: the model's); may be repeated")
      ->allow_extra_args(false);
  command->add_option("--time-step", options->settings.time_step, "Time between rows, s")
      ->check(CLI::Range(1e-5, 10.0))
      ->capture_default_str();
  command
      ->add_option("--speed", options->speed_deg,
                   "Largest angular speed on the way from pose to pose, degrees/s; 0: each row is the next pose")
      ->check(CLI::Range(0.0, 1e5))
      ->capture_default_str();
  static const std::map<std::string, opensim::CombinedPoses> combined = {{"none", opensim::CombinedPoses::none},
                                                                         {"grid", opensim::CombinedPoses::grid},
                                                                         {"halton", opensim::CombinedPoses::halton},
                                                                         {"latin", opensim::CombinedPoses::latin}};
  command
      ->add_option("--combined", options->settings.combined,
                   "Poses of all of a joint's angles together: grid (default; every combination of steps), halton, "
                   "latin (a Latin hypercube), none")
      ->transform(CLI::CheckedTransformer(combined));
  command->add_option("--samples", options->settings.samples, "Poses of halton and latin")
      ->check(CLI::Range(1, 20000))
      ->capture_default_str();
  command->add_option("--seed", options->settings.seed, "Of latin")->capture_default_str();
  command->add_option("--out", options->out, "Folder for the motions (.mot)")->required();
  command->add_flag("--json", options->json, "Print the files with joints and rows as JSON, for programs");
  command->callback([&chosen, options] { chosen = [options] { return write_motions(*options); }; });
}

}  // namespace gracilis
