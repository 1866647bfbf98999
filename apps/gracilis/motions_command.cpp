#include "motions_command.hpp"

#include "opensim_model.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/opensim/kinematics/sample_motions.hpp>
#include <gracilis/scene/names.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>

namespace gracilis {

namespace {

namespace fs = std::filesystem;

struct MotionsOptions {
  fs::path model, out;
  std::vector<std::string> joints;
  int steps = 8;
};

int write_motions(const MotionsOptions& options) {
  const opensim::Model model = read_opensim_model(options.model, false);
  std::vector<std::string> known;
  for (const opensim::Joint& joint : model.joints) known.push_back(joint.name);
  for (const std::string& name : options.joints)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw ConfigurationError(
          {"--joint", "", fmt::format("the model has no joint '{}'", name), suggestion(name, known)});
  fs::create_directories(options.out);
  std::set<std::string> taken;
  for (const opensim::Joint& joint : model.joints) {
    const bool asked = std::find(options.joints.begin(), options.joints.end(), joint.name) != options.joints.end();
    if (!asked && !options.joints.empty()) continue;
    for (const opensim::SampleMotion& sample : opensim::sample_motions(model, joint, options.steps)) {
      const fs::path path = options.out / (file_name_of(sample.name, taken) + ".mot");
      write_sto(path, opensim::coordinate_table(model, sample.motion));
      fmt::print("{}\n", path.string());
    }
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_motions_command(CLI::App& program, Command& chosen) {
  CLI::App* command =
      program.add_subcommand("motions", "Sample motions that fill the space of an OpenSim model's joints");
  const auto options = std::make_shared<MotionsOptions>();
  command->add_option("MODEL", options->model, "OpenSim model (.osim)")->required();
  command->add_option("--joint", options->joints, "Joint; may be repeated (default: all)")->allow_extra_args(false);
  command->add_option("--steps", options->steps, "Steps from one end of a coordinate's range to the other")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder for the motions (.mot)")->required();
  command->callback([&chosen, options] { chosen = [options] { return write_motions(*options); }; });
}

}  // namespace gracilis
