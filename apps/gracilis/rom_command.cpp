#include "rom_command.hpp"

#include "model_arms.hpp"
#include "scene_options.hpp"
#include "session.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/tables/arm_reference.hpp>
#include <gracilis/view/session/coordinate_range.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace gracilis {

/// The coordinate that moves; empty where none does.
static std::string moving_name(const std::vector<CoordinateRange>& ranges) {
  for (const CoordinateRange& range : ranges)
    if (range.moves()) return range.name;
  return "";
}

/// Slopes that are not known are NaN, which JSON has as null.
static nlohmann::ordered_json json_of(const std::string& source, const ArmComparison& beside) {
  const Real per_degree = 1e3 * radians(1);
  return {{"source", source},
          {"from_deg", degrees(beside.from)},
          {"to_deg", degrees(beside.to)},
          {"rms_mm", 1e3 * beside.rms},
          {"largest_mm", 1e3 * beside.largest},
          {"slope_mm_per_deg", per_degree * beside.slope},
          {"reference_slope_mm_per_deg", per_degree * beside.reference_slope}};
}

static void print_json(const std::filesystem::path& folder, const MomentArmReport& report) {
  nlohmann::ordered_json muscles = nlohmann::json::array();
  for (const MuscleArms& arms : report.muscles) {
    const std::string unit = arms.translation ? "_mm_per_m" : "_mm";
    nlohmann::ordered_json told = {{"muscle", arms.muscle},
                                   {"coordinate", arms.coordinate},
                                   {"least" + unit, 1e3 * arms.least},
                                   {"most" + unit, 1e3 * arms.most}};
    if (!arms.translation) told["largest_step_mm_per_deg"] = 1e3 * arms.largest_step;
    told["beside"] = nlohmann::json::array();
    for (const auto& [source, beside] : arms.beside) told["beside"].push_back(json_of(source, beside));
    muscles.push_back(std::move(told));
  }
  fmt::print("{}", json_text({{"folder", folder.string()}, {"muscles", muscles}}));
}

/// Lines to the standard output, warnings to the log.
static void tell(const std::filesystem::path& folder, const MomentArmReport& report, bool as_json) {
  if (as_json)
    print_json(folder, report);
  else
    for (const std::string& line : report.lines) fmt::print("{}\n", line);
  for (const std::string& warning : report.warnings) spdlog::warn("{}", warning);
}

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
      ->add_option(
          "--coord", options->coordinates,
          "NAME=FROM:TO:STEP in degrees, as in hip_flexion_r=-10:60:2, or in mm where the coordinate is a "
          "translation; NAME=VALUE fixes another coordinate. May be repeated; where several move, the scene goes "
          "through all combinations, the first fastest")
      ->required()
      ->allow_extra_args(false);
  command->add_option(
      "--reference", options->reference,
      "Published moment arms to compare with and to draw: a .csv with the columns muscle, angle_deg and "
      "moment_arm_mm, and perhaps coordinate, source, min and max; a moment_arms.sto of another 'rom'; or an OpenSim "
      "model (.osim), whose muscles' arms are taken over the same range");
  add_session_options(*command, options->session);
  command->get_option("--json")->description("Print what lines say of moment arms as JSON, for programs");
  CLI::Option* tables_only = command->add_flag(
      "--tables-only", options->session.tables_only,
      "Write fiber lengths, moment arms and their plots, but no run: no surfaces, measures or lines of action");
  for (const char* of_runs : {"--resume", "--every", "--no-ramp", "--no-fibers", "--no-pictures", "--metrics",
                              "--layout", "--strict", "--corrections"})
    tables_only->excludes(command->get_option(of_runs));
  options->session.command = words;
  command->callback([&chosen, options] {
    chosen = [options] {
      std::vector<CoordinateRange> ranges;
      for (const std::string& text : options->coordinates) ranges.push_back(parse_coordinate_range(text));
      std::vector<ArmCurve> references;
      const bool compares = !options->reference.empty();
      const bool with_model = compares && lower_case_extension(options->reference) == ".osim";
      if (compares && !with_model) references = read_arm_reference(options->reference, moving_name(ranges));
      LoadedScene loaded = read_scene(options->file, options->scene);
      if (options->session.out.empty()) options->session.out = range_folder(loaded.scene);
      const std::vector<MovedCoordinate> moved = move_through(ranges, loaded);
      if (moved.size() > 1 && compares)
        throw ConfigurationError(
            {"--reference", "", "is about one coordinate", "let one move and give the others one value"});
      if (with_model) references = model_arms(options->reference, loaded.scene, ranges);
      options->session.fiber_actions = true;
      options->session.print_folder = !options->session.json;
      const int code = run_session(loaded, options->session);
      if (code != static_cast<int>(ExitCode::interrupted))
        tell(options->session.out, write_moment_arms(options->session.out, loaded.scene, moved, references),
             options->session.json);
      return code;
    };
  });
}

}  // namespace gracilis
