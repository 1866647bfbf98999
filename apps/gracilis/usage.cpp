#include "usage.hpp"

#include "option_text.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/suggestions.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace gracilis {

namespace {

struct Example {
  const char *command, *line;
};

constexpr Example examples[] = {
    {"demo", "gracilis demo --flexion 90 --out hip"},
    {"run", "gracilis run leg.toml --out leg --threads 2"},
    {"compare", "gracilis compare leg.toml --methods xpbd,tissue --out compared"},
    {"rom", "gracilis rom hip.toml --coord hip_flexion_r=-10:60:2 --out arms"},
    {"study", "gracilis study run study.toml --shard 1/4"},
    {"calibrate", "gracilis calibrate hip.toml --targets targets.toml --out calibrated"},
    {"fibers", "gracilis fibers leg.toml --out fibers"},
    {"activations", "gracilis activations join walks results --out joined.sto"},
    {"print-config", "gracilis print-config > scene.toml"},
    {"bench", "gracilis bench leg.toml --frame 10"},
    {"inspect", "gracilis inspect leg.toml"},
    {"render", "gracilis render leg --view lateral --out leg.png"},
    {"export", "gracilis export leg --to obj --frames 0,45,90 --out surfaces"},
    {"report", "gracilis report leg"},
    {"verify", "gracilis verify leg"},
    {"view", "gracilis view leg.toml"},
    {"prepare", "gracilis prepare biceps.stl triceps.stl --bone humerus.stl --unit mm --out prepared"},
    {"new", "gracilis new hip_bone_r.ply femur_r.ply gluteus_maximus_r.ply --out hip.toml"},
    {"scene", "gracilis scene scans --out leg.toml"},
    {"transfer", "gracilis transfer hip.toml --bones scans --out subject"},
    {"wrap", "gracilis wrap model.osim hip.toml --geometry Geometry --out wrapped.osim"},
    {"import", "gracilis import model.osim --motion walk.mot --out walk"},
    {"motions", "gracilis motions model.osim --joint hip_r --out motions"},
    {"paths", "gracilis paths model.osim --coord hip_flexion_r=-10:60:2 --out paths"},
    {"static-optimization", "gracilis static-optimization setup.xml --out activations"},
};

std::vector<std::string> command_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* part : command.get_subcommands({})) names.push_back(part->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The commands that were read, as study and run, down to the one in which parsing ended.
std::vector<const CLI::App*> commands_read(const CLI::App& program) {
  std::vector<const CLI::App*> commands;
  for (const CLI::App* command = &program; !command->get_subcommands().empty();)
    commands.push_back(command = command->get_subcommands().back());
  return commands;
}

/// Of an option that takes only some values and got another; empty: the error is about something else.
std::string value_problem(const CLI::App& command, const CLI::ParseError& error) {
  for (const CLI::Option* option : named_options(command)) {
    const std::vector<std::string> choices = choices_of(*option);
    if (choices.empty() || !std::string_view(error.what()).starts_with(option->get_name() + ":")) continue;
    for (const std::string& value : option->results())
      if (std::find(choices.begin(), choices.end(), value) == choices.end())
        return fmt::format("{} does not know '{}' ({}", option->get_name(), value, suggestion(value, choices));
  }
  return "";
}

bool is_option(const std::string& word) { return word.starts_with("-") && word != "-"; }

}  // namespace

std::string first_steps() {
  return "Gracilis: bones, muscle surfaces and a motion become deforming, contracting muscles.\n"
         "\n"
         "  gracilis demo                      a hip flexes; needs no file, and shows where its picture is\n"
         "  gracilis new *.ply --out my.toml   a commented scene of your own surfaces, to correct and fill in\n"
         "  gracilis inspect my.toml           what a run would refuse, and what mends it\n"
         "  gracilis run my.toml --out my      the whole motion\n"
         "  gracilis report my                 a page about it for the browser\n"
         "\n"
         "`gracilis --help` lists all commands, `gracilis COMMAND --help` explains one.\n";
}

static constexpr const char* ends_of_program =
    "Exit codes:\n"
    "  0    done\n"
    "  1    internal error, out of memory\n"
    "  2    wrong usage or configuration; a run of more than 2 GB that nobody said yes to\n"
    "  3    a file is missing, unreadable or unfit, or cannot be written\n"
    "  4    this machine or program does not offer what is asked, as OpenGL or a display\n"
    "  5    quality: a value is not finite, or with --strict a frame missed a gate\n"
    "  130  interrupted; --resume goes on\n"
    "\n"
    "Environment:\n"
    "  GRACILIS_DATA  folder in which files of scenes are looked for\n"
    "  NO_COLOR       no colors, on terminals, too\n"
    "\n"
    "Example: gracilis demo";

void add_examples(CLI::App& program) {
  program.footer(ends_of_program);
  for (CLI::App* command : program.get_subcommands({}))
    for (const Example& example : examples)
      if (command->get_name() == example.command) {
        const std::string own = command->get_footer();
        command->footer((own.empty() ? "" : own + "\n") + "Example: " + example.line);
      }
}

std::string usage_problem(const CLI::App& program, const CLI::ParseError& error,
                          const std::vector<std::string>& words) {
  const std::vector<const CLI::App*> commands = commands_read(program);
  const CLI::App& command = commands.empty() ? program : *commands.back();
  std::vector<std::string> names;
  for (const CLI::App* each : commands) names.push_back(each->get_name());
  const std::string path = fmt::format("{}", fmt::join(names, " "));
  const std::string begin = path.empty() ? "" : path + ": ";
  const std::string help = "`gracilis " + (path.empty() ? "" : path + " ") + "--help` ";
  const std::vector<std::string> parts = command_names(command);
  if (const std::size_t next = commands.size() + 1; !parts.empty() && next < words.size() && !is_option(words[next]))
    return fmt::format("{}there is no command '{}' ({}; {}lists all)", begin, words[next],
                       suggestion(words[next], parts), help);
  const std::vector<std::string> known = option_names(command);
  for (const std::string& word : words) {
    const std::string option = word.substr(0, word.find('='));
    if (option.starts_with("--") && std::find(known.begin(), known.end(), option) == known.end())
      return fmt::format("{}there is no option '{}' ({}; {}explains all)", begin, option, suggestion(option, known),
                         help);
  }
  if (const std::string problem = value_problem(command, error); !problem.empty())
    return begin + problem + "; " + help + "explains all)";
  return begin + error.what() + " (" + help + "explains)";
}

}  // namespace gracilis
