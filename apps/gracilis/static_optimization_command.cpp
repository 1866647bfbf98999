#include "static_optimization_command.hpp"

#include "console.hpp"
#include "opensim_model.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/opensim/kinematics/low_pass.hpp>
#include <gracilis/opensim/reader/model_notes.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>
#include <gracilis/opensim/static_optimization/optimization_notes.hpp>
#include <gracilis/opensim/static_optimization/setup_reader.hpp>
#include <gracilis/scene/names.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <map>
#include <memory>
#include <optional>

namespace gracilis {

namespace {

namespace fs = std::filesystem;

/// What the command line says; where it says nothing, the set-up file does.
struct OptimizationOptions {
  fs::path setup, model, motion, loads, out, known_forces;
  opensim::ReactionSettings reactions = {{}, {"child"}, {"ground"}};
  std::vector<fs::path> forces;
  bool replace = false, isometric = false, strict = false, json = false;
  std::optional<Real> begin, end, cutoff, exponent;
  std::optional<opensim::MuscleForces> muscles;
  std::optional<int> every;
};

opensim::StaticOptimizationSetup setup_from(const OptimizationOptions& options) {
  opensim::StaticOptimizationSetup setup;
  if (!options.setup.empty()) setup = opensim::read_setup(options.setup);
  if (!options.model.empty()) setup.model = options.model;
  if (!options.motion.empty()) setup.coordinates = options.motion;
  if (!options.loads.empty()) setup.external_loads = options.loads;
  if (!options.forces.empty()) setup.force_sets = options.forces;
  if (options.replace) setup.replace_force_set = true;
  if (options.isometric) setup.settings.use_muscle_physiology = false;
  if (!options.reactions.joints.empty() || !options.known_forces.empty()) {
    if (!setup.reactions) setup.reactions.emplace();
    if (!options.reactions.joints.empty()) setup.reactions->settings = options.reactions;
    setup.reactions->forces = options.known_forces;
    setup.optimizes = options.known_forces.empty();
  }
  setup.settings.muscle_forces = options.muscles.value_or(setup.settings.muscle_forces);
  setup.begin = options.begin.value_or(setup.begin);
  setup.end = options.end.value_or(setup.end);
  setup.cutoff = options.cutoff.value_or(setup.cutoff);
  setup.step_interval = options.every.value_or(setup.step_interval);
  setup.settings.exponent = options.exponent.value_or(setup.settings.exponent);
  if (setup.model.empty() || setup.coordinates.empty())
    throw ConfigurationError(
        {"", "", "static optimization needs a model and coordinates", "give a set-up file, or --model and --motion"});
  const bool from_setup = options.model.empty() && !options.setup.empty();
  if (from_setup && !is_there(setup.model))
    throw InputError({options.setup.string(), "model_file", "names a model that is not there: " + setup.model.string(),
                      "name one with --model"});
  if (options.motion.empty() && !options.setup.empty() && !is_there(setup.coordinates))
    throw InputError({options.setup.string(), "coordinates_file",
                      "names a motion that is not there: " + setup.coordinates.string(), "name one with --motion"});
  if (!(setup.settings.exponent > 1))
    throw ConfigurationError({"--exponent", "", "the exponent must be larger than 1", ""});
  return setup;
}

opensim::Model model_with_forces(const opensim::StaticOptimizationSetup& setup, bool strict) {
  opensim::Model model = read_opensim_model(setup.model, strict);
  bool replace = setup.replace_force_set;
  for (const fs::path& path : setup.force_sets) {
    const std::size_t known = model.unsupported.size();
    opensim::read_force_set(path, replace, model);
    report_unsupported(model, known, strict);
    replace = false;
  }
  return model;
}

opensim::CoordinateMotion motion_of(const opensim::Model& model, const opensim::StaticOptimizationSetup& setup) {
  const Table table = read_table(setup.coordinates);
  for (const std::string& warning : table.warnings) spdlog::warn("{}", warning);
  opensim::CoordinateMotion motion = opensim::coordinate_motion(model, table);
  for (const std::string& note : motion.notes) spdlog::warn("{}", note);
  if (setup.cutoff > 0) motion.values = opensim::low_pass(motion.times, motion.values, setup.cutoff);
  return motion;
}

/// Writes tables into a folder, and keeps their names.
struct ResultFiles {
  fs::path folder;
  std::string start;
  std::vector<std::string> written = {};

  void write(const std::string& what, const Table& table) {
    const fs::path path = folder / fmt::format("{}_{}.sto", file_name_of(start), file_name_of(what));
    write_sto(path, table);
    written.push_back(path.string());
  }
};

void write_results(const std::string& analysis, const opensim::StaticOptimizationResult& result, ResultFiles& files) {
  files.write(analysis + "_activation", result.activations);
  files.write(analysis + "_force", result.forces);
  if (!result.fiber_lengths.columns.empty()) files.write(analysis + "_fiber_length", result.fiber_lengths);
}

/// What was written, at which instants muscles were too weak and by how much (N·m or N), and what else is to be known.
void print_json(const ResultFiles& files, std::size_t rows, const std::vector<opensim::InfeasibleInstant>& infeasible,
                const std::vector<std::string>& notes) {
  nlohmann::ordered_json weak = nlohmann::json::array();
  for (const opensim::InfeasibleInstant& each : infeasible) {
    nlohmann::ordered_json missing = nlohmann::json::object();
    for (const auto& [coordinate, amount] : each.missing) missing[coordinate] = amount;
    weak.push_back({{"time", each.time}, {"missing", missing}});
  }
  fmt::print("{}", json_text({{"rows", rows}, {"files", files.written}, {"too_weak", weak}, {"notes", notes}}));
}

int optimize(const OptimizationOptions& options) {
  const opensim::StaticOptimizationSetup setup = setup_from(options);
  for (const std::string& note : setup.notes) spdlog::warn("{}: {}", options.setup.string(), note);
  const opensim::Model model = model_with_forces(setup, options.strict);
  const opensim::CoordinateMotion motion = motion_of(model, setup);
  opensim::ExternalLoads loads;
  if (!setup.external_loads.empty()) loads = opensim::read_external_loads(model, setup.external_loads);
  const std::vector<std::size_t> rows = opensim::rows_of(setup, motion.times);
  if (rows.empty())
    throw ConfigurationError({setup.coordinates.string(), "", "has no row between the times asked for", ""});
  std::vector<std::string> notes;
  const std::string unmeasured =
      opensim::unmeasured_loads_note(loads, motion.times[rows.front()], motion.times[rows.back()]);
  if (!unmeasured.empty()) notes.push_back(fmt::format("{}: {}", setup.external_loads.string(), unmeasured));
  for (const std::string& note : notes) spdlog::warn("{}", note);
  fs::create_directories(options.out);
  ResultFiles files{options.out, setup.name};
  std::vector<opensim::InfeasibleInstant> infeasible;
  Table forces;
  if (setup.optimizes) {
    Progress progress(0, static_cast<int>(rows.size()));
    const opensim::StaticOptimizationResult result = opensim::static_optimization(
        model, motion, loads, rows, setup.settings, [&](std::size_t done) { progress.show(static_cast<int>(done)); });
    progress.clear();
    for (const std::string& note : opensim::weakness_notes(result)) spdlog::warn("{}", note);
    infeasible = result.infeasible;
    forces = result.forces;
    write_results(setup.analysis, result, files);
  }
  if (setup.reactions) {
    if (!setup.reactions->forces.empty()) forces = read_table(setup.reactions->forces);
    files.write(setup.reactions->name + "_ReactionLoads",
                opensim::joint_reactions(model, motion, loads, rows, forces, setup.reactions->settings));
  }
  // Last, so that nobody takes the results for those of the whole model.
  if (const std::string note = opensim::missing_forces_note(model); !note.empty()) {
    spdlog::warn("{}", note);
    notes.push_back(note);
  }
  if (options.json)
    print_json(files, rows.size(), infeasible, notes);
  else
    for (const std::string& file : files.written) fmt::print("{}\n", file);
  const bool failed = options.strict && !infeasible.empty();
  return static_cast<int>(failed ? ExitCode::quality : ExitCode::done);
}

}  // namespace

void add_static_optimization_command(CLI::App& program, Command& chosen) {
  CLI::App* command = program.add_subcommand("static-optimization",
                                             "Activations of an OpenSim model's muscles that give a measured motion");
  const auto options = std::make_shared<OptimizationOptions>();
  command->add_option("SETUP", options->setup, "OpenSim's set-up file of static optimization (.xml)");
  command->add_option("--model", options->model, "OpenSim model (.osim)");
  command->add_option("--motion", options->motion, "Coordinates over time (.mot, .sto)");
  command->add_option("--loads", options->loads, "External loads (.xml, beside its table)");
  command->add_option("--forces", options->forces, "Force set with more actuators (.xml); may be repeated")
      ->allow_extra_args(false);
  command->add_flag("--replace", options->replace, "Take the model's own forces away first");
  command->add_option("--out", options->out, "Folder for the results")->required();
  command->add_option("--begin", options->begin, "First time, s");
  command->add_option("--end", options->end, "Last time, s");
  command->add_option("--every", options->every, "Take every so many rows of the motion")->check(CLI::PositiveNumber);
  command->add_option("--cutoff", options->cutoff, "Low-pass filter of the coordinates, Hz");
  command->add_option("--exponent", options->exponent, "Minimize the sum of activations to this power (2)");
  command->add_flag("--isometric", options->isometric, "Forces do not depend on length and velocity");
  command
      ->add_option("--muscles", options->muscles,
                   "What muscles pull with: opensim (active force on rigid tendons, as OpenSim's static optimization), "
                   "rigid (passive force, too), elastic (fibers and tendons in equilibrium)")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, opensim::MuscleForces>{{"opensim", opensim::MuscleForces::opensim},
                                                       {"rigid", opensim::MuscleForces::rigid},
                                                       {"elastic", opensim::MuscleForces::elastic}}));
  command
      ->add_option(
          "--reactions", options->reactions.joints,
          "Also the loads in these joints, as in knee_r,ankle_r or ALL (a set-up may ask for them: JointReaction)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--on", options->reactions.on, "Loads on child or parent of the joint (child)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--in", options->reactions.in, "In the axes of ground, child, parent or a body (ground)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--known-forces", options->known_forces,
                   "Muscles' and actuators' forces (.sto): joint loads with these, without an optimization")
      ->check(CLI::ExistingFile);
  command->add_flag("--strict", options->strict,
                    "Fail where something is not supported (exit code 4) or muscles are too weak (5)");
  command->add_flag("--json", options->json,
                    "Print what was written, and where muscles are too weak, as JSON, for programs");
  command->callback([&chosen, options] { chosen = [options] { return optimize(*options); }; });
}

}  // namespace gracilis
