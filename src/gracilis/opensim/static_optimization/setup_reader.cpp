#include <gracilis/opensim/static_optimization/setup_reader.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/whole_number.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/opensim/reader/model_file.hpp>
#include <gracilis/opensim/reader/xml.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

static std::filesystem::path file_of(const XmlContext& context, const pugi::xml_node& node, const char* name) {
  const std::string named = context.text(node, name);
  return named.empty() || named == "Unassigned" ? std::filesystem::path() : file_beside(context.path, named);
}

/// The rows that an analysis is made at.
static void read_times(const XmlContext& context, const pugi::xml_node& node, StaticOptimizationSetup& setup) {
  setup.begin = std::max(setup.begin, context.number(node, "start_time", setup.begin));
  setup.end = std::min(setup.end, context.number(node, "end_time", setup.end));
  const Real interval = context.number(node, "step_interval", 1);
  const std::optional<int> step = whole_number<int>(interval, 1);
  if (!step) context.fail(node, fmt::format("<step_interval> is {}", interval), "give a whole number from 1 on");
  setup.step_interval = *step;
}

static void read_optimization(const XmlContext& context, const pugi::xml_node& node, StaticOptimizationSetup& setup) {
  if (!name_of(node).empty()) setup.analysis = name_of(node);
  read_times(context, node, setup);
  setup.settings.exponent = context.number(node, "activation_exponent", 2);
  setup.settings.use_muscle_physiology = context.boolean(node, "use_muscle_physiology", true);
  if (!context.boolean(node, "use_model_force_set", true))
    setup.notes.push_back("<use_model_force_set> false is not followed: the model's own forces take part");
}

static void read_reactions(const XmlContext& context, const pugi::xml_node& node, StaticOptimizationSetup& setup) {
  ReactionSetup reactions;
  if (!name_of(node).empty()) reactions.name = name_of(node);
  reactions.forces = file_of(context, node, "forces_file");
  const auto read_names = [&](const char* name, std::vector<std::string>& list) {
    const std::string text = context.text(node, name);
    const auto words = words_of(text);
    if (!words.empty()) list.assign(words.begin(), words.end());
  };
  read_names("joint_names", reactions.settings.joints);
  read_names("apply_on_bodies", reactions.settings.on);
  read_names("express_in_frame", reactions.settings.in);
  setup.reactions = std::move(reactions);
}

static void read_analyses(const XmlContext& context, const pugi::xml_node& tool, StaticOptimizationSetup& setup) {
  setup.optimizes = false;
  pugi::xml_node reactions;
  for (const pugi::xml_node& node : objects_of(tool, "AnalysisSet")) {
    const std::string_view kind = node.name();
    if (kind == "StaticOptimization") {
      setup.optimizes = true;
      read_optimization(context, node, setup);
    } else if (kind == "JointReaction" && context.boolean(node, "on", true)) {
      reactions = node;
      read_reactions(context, node, setup);
    } else {
      setup.notes.push_back(fmt::format("analysis {} is left out", kind));
    }
  }
  if (!setup.optimizes && setup.reactions && !setup.reactions->forces.empty())
    read_times(context, reactions, setup);
  else if (!setup.optimizes)
    context.fail(tool, "has no StaticOptimization among its analyses, nor a JointReaction with a file of forces",
                 "add one");
}

StaticOptimizationSetup read_setup(const std::filesystem::path& path) {
  const XmlFile file = read_xml(path);
  const pugi::xml_node tool = file.root.child("AnalyzeTool");
  if (!tool) throw InputError({path.string(), "", "holds no AnalyzeTool", "name a set-up of static optimization"});
  const XmlContext context{path, tool.child("defaults"), file.version};
  StaticOptimizationSetup setup;
  if (!name_of(tool).empty()) setup.name = name_of(tool);
  setup.model = file_of(context, tool, "model_file");
  setup.coordinates = file_of(context, tool, "coordinates_file");
  setup.external_loads = file_of(context, tool, "external_loads_file");
  setup.results = context.text(tool, "results_directory");
  const std::string sets = context.text(tool, "force_set_files");
  for (const std::string_view name : words_of(sets))
    if (name != "Unassigned") setup.force_sets.push_back(file_beside(path, std::string(name)));
  setup.replace_force_set = context.boolean(tool, "replace_force_set", false);
  setup.begin = context.number(tool, "initial_time", setup.begin);
  setup.end = context.number(tool, "final_time", setup.end);
  setup.cutoff = context.number(tool, "lowpass_cutoff_frequency_for_coordinates", -1);
  for (const char* unused : {"states_file", "speeds_file"})
    if (!file_of(context, tool, unused).empty()) setup.notes.push_back(fmt::format("<{}> is not read", unused));
  read_analyses(context, tool, setup);
  return setup;
}

std::vector<std::size_t> rows_of(const StaticOptimizationSetup& setup, const std::vector<Real>& times) {
  const Real rounding = 1e-9;
  std::vector<std::size_t> all, rows;
  for (std::size_t i = 0; i < times.size(); ++i)
    if (times[i] >= setup.begin - rounding && times[i] <= setup.end + rounding) all.push_back(i);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i % static_cast<std::size_t>(setup.step_interval) == 0 || i + 1 == all.size()) rows.push_back(all[i]);
  return rows;
}

}  // namespace gracilis::opensim
