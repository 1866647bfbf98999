#include "export_command.hpp"

#include "console.hpp"
#include "exported_paths.hpp"
#include "run_scene.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/run/run_manifest.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/opensim/export/arm_courses.hpp>
#include <gracilis/opensim/export/export_check.hpp>
#include <gracilis/opensim/export/muscle_points.hpp>
#include <gracilis/opensim/export/replace_paths.hpp>
#include <gracilis/opensim/export/run_paths.hpp>
#include <gracilis/opensim/export/run_points.hpp>
#include <gracilis/opensim/export/scene_lengths.hpp>
#include <gracilis/opensim/kinematics/loop_closer.hpp>
#include <gracilis/opensim/reader/model_reader.hpp>
#include <gracilis/view/comparison/arm_page.hpp>
#include <gracilis/view/export/export_gltf.hpp>
#include <gracilis/view/export/export_surfaces.hpp>
#include <gracilis/view/export/export_tables.hpp>
#include <gracilis/view/export/export_tetrahedra.hpp>
#include <gracilis/view/export/export_usd.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <numeric>

namespace gracilis {

namespace {

struct ExportOptions {
  std::filesystem::path run, out, model, check, page;
  std::string to;
  std::vector<int> frames;
  AnimationOptions animation;
  Real specific_tension = 6.1e5;
  Index points = 12;
  opensim::MuscleFitSettings fit;
  Index sampled = 0;  ///< poses that --sample asked for
  bool json = false;
};

/// For programs: what was written, and what a format adds to it.
using Told = nlohmann::ordered_json;

/// One thing that `--to` can say.
struct ExportFormat {
  const char* name;
  const char* default_out;  ///< within the run's folder
  const char* meaning;
  void (*write)(const RecordedRun& run, const std::filesystem::path& out, const ExportOptions& options, Told& told);
};

std::vector<int> frames_or_all(const RecordedRun& run, const std::vector<int>& chosen) {
  if (chosen.empty()) {
    std::vector<int> all(static_cast<std::size_t>(run.frame_count));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  for (const int frame : chosen) {
    if (frame < 0 || frame >= run.frame_count)
      throw ConfigurationError({"--frames", "", fmt::format("there is no frame {}", frame),
                                fmt::format("the run has frames 0 to {}", run.frame_count - 1)});
  }
  return chosen;
}

/// Says what became of muscles and, with --check, of static optimization.
void say_left_out(const std::vector<std::string>& left_out) {
  for (const std::string& line : left_out) spdlog::warn("{}; it keeps its original path", line);
}

void check_against(const opensim::Model& before, const opensim::Model& after, const std::filesystem::path& setup) {
  for (const std::string& line : opensim::check_lines(opensim::check_export(before, after, opensim::read_setup(setup))))
    spdlog::info("{}", line);
}

/// With --check and --page what the exported paths do, beside the model's own.
void compare_paths(const opensim::Model& before, const opensim::Model& after, const Eigen::MatrixXd& coordinates,
                   const ExportOptions& options, const std::vector<std::string>& lines) {
  if (!options.check.empty()) check_against(before, after, options.check);
  if (options.page.empty()) return;
  const std::string heading =
      fmt::format("{}: moment arms of {}", before.name,
                  std::filesystem::absolute(options.run).lexically_normal().filename().string());
  write_arm_page(options.page, heading, lines, opensim::arm_courses(before, after, coordinates));
  spdlog::info("moment arms before and after: {}", options.page.string());
}

std::vector<opensim::Muscle> muscles_in(const std::filesystem::path& force_set, opensim::Model model) {
  opensim::read_force_set(force_set, true, model);
  return model.muscles;
}

/// What lengths the run's fibers would have along the model's lines, from its scene; a run whose scene is gone goes
/// without.
void compare_with_lines(const ExportOptions& options, opensim::LengthSamples& run) {
  try {
    opensim::add_line_lengths(scene_of_run(options.run).scene, options.run, run);
  } catch (const Error& error) {
    spdlog::warn(
        "the run's scene cannot be read ({}), so corrections are beside the model's paths, which fibers lie beside",
        error.what());
  }
}

/// The run's lengths; of strings, where poses are asked for, lengths and arms of its scene in such poses.
opensim::LengthSamples lengths_for(const opensim::Model& model, const ExportOptions& options, Index fiber_points = 0) {
  opensim::LengthSamples run = opensim::run_lengths(options.run, model);
  const bool strings = read_manifest(options.run).value("settings", "").starts_with("method = \"strings\"");
  const bool corrects = !options.model.empty() && !options.fit.run_alone && fiber_points == 0;
  if (corrects && !strings && !run.follow_lines) compare_with_lines(options, run);
  if (options.sampled == 0 || !strings) return run;
  const LoadedScene loaded = scene_of_run(options.run);
  const auto method = make_method(
      loaded.scene, [&](const DistanceFieldSettings& settings) { return cached_bone_fields(loaded.scene, settings); });
  const opensim::CoordinateBox box = opensim::box_around(model, opensim::moved_coordinates(run, model, loaded.scene),
                                                         run.coordinates, options.fit.whole_ranges);
  Progress progress(0, static_cast<int>(options.sampled));
  run = opensim::scene_lengths(
      loaded.scene, *method, model, box, options.sampled, [&](Index done) { progress.show(static_cast<int>(done)); },
      fiber_points);
  progress.clear();
  return run;
}

opensim::Model closed_model(const std::filesystem::path& path) {
  opensim::Model model = opensim::read_model(path);
  opensim::assemble_defaults(model);
  return model;
}

Told export_functions(const std::filesystem::path& out, const ExportOptions& options) {
  if (options.model.empty())
    spdlog::warn("without --model polynomials are fitted to the run's own poses alone, and the joints are the scene's");
  const opensim::Model model =
      options.model.empty() ? opensim::joints_of_run(options.run) : closed_model(options.model);
  opensim::MuscleFitSettings settings = options.fit;
  if (options.sampled > 0) settings.poses = options.sampled;
  const opensim::LengthSamples lengths = lengths_for(model, options);
  const opensim::FittedMuscles fitted = opensim::fit_muscles(lengths, model, settings);
  write_text_atomically(out, opensim::function_path_set(model, fitted.muscles));
  for (const opensim::FittedMuscle& muscle : fitted.muscles) spdlog::info("{}", opensim::fit_line(model, muscle));
  say_left_out(fitted.left_out);
  spdlog::info("{}", opensim::fit_summary(model, fitted.muscles));
  if (!model.muscles.empty()) {
    opensim::Model after = model;
    opensim::replace_paths(out, after);
    compare_paths(model, after, lengths.coordinates, options, {opensim::fit_summary(model, fitted.muscles)});
  }
  return as_json(model, fitted);
}

Told export_path_points(const std::filesystem::path& out, const ExportOptions& options) {
  if (options.model.empty())
    throw ConfigurationError({"--to osim-points", "", "needs the model", "add --model MODEL.osim"});
  const opensim::Model model = closed_model(options.model);
  const opensim::LengthSamples samples = lengths_for(model, options, options.points);
  if (options.sampled > 0 && !samples.spread)
    spdlog::warn("--sample: only a run by strings can be solved in other poses; points are fitted to the run's own");
  const opensim::PointExport exported =
      opensim::export_points(options.run, options.model, model, samples, options.points, out);
  for (const opensim::WrittenPath& path : exported.written)
    spdlog::info("{}: {} points; {}", path.muscle, path.points,
                 opensim::point_errors_text(path.errors, path.beside_model));
  say_left_out(exported.left_out);
  if (!options.check.empty() || !options.page.empty()) {
    opensim::Model after = model;
    for (const opensim::Muscle& muscle : muscles_in(out, model)) {
      const Index known = opensim::index_of(after.muscles, muscle.name);
      if (known < 0) continue;
      after.muscles[static_cast<std::size_t>(known)].path = muscle.path;
      after.muscles[static_cast<std::size_t>(known)].tendon_slack_length = muscle.tendon_slack_length;
    }
    compare_paths(model, after, samples.coordinates, options, {});
  }
  return as_json(exported);
}

/// A new format is a line here.
const std::vector<ExportFormat>& formats() {
  static const std::vector<ExportFormat> list = {
      {"gltf", "run.glb", "one .glb that plays in viewers, muscles as morph targets",
       [](const RecordedRun& run, const std::filesystem::path& out, const ExportOptions& options, Told&) {
         export_gltf(run, out, options.animation);
       }},
      {"usd", "run.usda",
       "one .usda (OpenUSD's text) that plays in Blender, Houdini and usdview, muscles as meshes whose points move, "
       "fibers as curves",
       [](const RecordedRun& run, const std::filesystem::path& out, const ExportOptions& options, Told&) {
         export_usd(run, out, options.animation);
       }},
      {"csv", "csv", "a folder with all tables, and the muscles' points in --frames",
       [](const RecordedRun& run, const std::filesystem::path& out, const ExportOptions& options, Told&) {
         export_csv(run, out, options.frames.empty() ? options.frames : frames_or_all(run, options.frames));
       }},
      {"obj", "obj", "a folder with one .obj per frame",
       [](const RecordedRun& run, const std::filesystem::path& out, const ExportOptions& options, Told&) {
         export_obj(run, out, frames_or_all(run, options.frames));
       }},
      {"surfaces", "surfaces", "a folder with one .vtp per muscle, bone and frame, as compact runs do not have them",
       [](const RecordedRun& run, const std::filesystem::path& out, const ExportOptions& options, Told&) {
         export_surfaces(run, out, frames_or_all(run, options.frames));
       }},
      {"tetrahedra", "tetrahedra",
       "a folder with the volumes of muscles made of sections: .vtu with compartments and masses, and tables, in "
       "--frames",
       [](const RecordedRun& run, const std::filesystem::path& out, const ExportOptions& options, Told&) {
         export_tetrahedra(run, out, frames_or_all(run, options.frames), options.specific_tension);
       }},
      {"osim-function", "function_paths.osim",
       "the fibers' mean lengths as polynomials of the coordinates, which OpenSim 4.5 and later read as "
       "FunctionBasedPaths",
       [](const RecordedRun&, const std::filesystem::path& out, const ExportOptions& options, Told& told) {
         told.update(export_functions(out, options));
       }},
      {"osim-points", "point_paths.osim",
       "the mean fibers as path points of the --model, a force set that OpenSim appends to it or puts in the place of "
       "its forces",
       [](const RecordedRun&, const std::filesystem::path& out, const ExportOptions& options, Told& told) {
         told.update(export_path_points(out, options));
       }}};
  return list;
}

}  // namespace

void add_export_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* command = program.add_subcommand("export", "Write a run in other programs' formats");
  std::vector<std::string> names;
  std::string help = "Format";
  for (const ExportFormat& format : formats()) {
    names.push_back(format.name);
    help += fmt::format("; {}: {}", format.name, format.meaning);
  }
  command->add_option("RUN", options->run, "Run folder")->required();
  command->add_option("--to", options->to, help)->required()->check(CLI::IsMember(names));
  command->add_option("--out", options->out, "File or folder to write (default: within the run's folder)");
  command->add_option("--frames", options->frames, "These only, as in 0,45,90 (csv, obj, surfaces, tetrahedra)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--vertices", options->animation.muscle_vertices,
                   "About so many at most for each muscle (gltf, usd; 4000)")
      ->check(CLI::Range(50, 10'000'000));
  command->add_option("--most-frames", options->animation.frames, "At most so many frames (gltf, usd; 60)")
      ->check(CLI::Range(2, 100'000));
  command
      ->add_option("--specific-tension", options->specific_tension,
                   "Force per physiological cross-section area, N/m² (tetrahedra)")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--model", options->model,
                      "The OpenSim model that the run's scene was made of (osim-function, osim-points)");
  command->add_option("--points", options->points, "Points of a path at most, its ends among them (osim-points)")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  command->add_option(
      "--check", options->check,
      "OpenSim's set-up of static optimization: solved with the model's own paths and the exported ones, "
      "and compared (osim-function, osim-points)");
  command->add_option(
      "--page", options->page,
      "A page (.html) of all muscles' moment arms, the model's own and the exported ones, by coordinate "
      "(osim-function, osim-points with --model)");
  command
      ->add_option(
          "--sample", options->sampled,
          "Poses that polynomials are fitted to, spread over each muscle's coordinates: of the model's own paths, "
          "and of a run by strings those of its scene, which is solved in them (osim-function, 1000 of the model; "
          "osim-points, of strings)")
      ->check(CLI::Range(64, 1'000'000));
  command->add_flag("--whole-ranges", options->fit.whole_ranges,
                    "Over the whole ranges of the model's coordinates instead of 10 degrees around where the run goes "
                    "(osim-function)");
  command->add_flag("--run-alone", options->fit.run_alone,
                    "Fit to the run's lengths alone; otherwise muscles become the model's own path and a correction "
                    "(osim-function)");
  command->add_flag("--json", options->json,
                    "Print what was written, and how far exported paths are from the run, as JSON, for programs");
  command->callback([&chosen, options] {
    chosen = [options] {
      for (const ExportFormat& format : formats()) {
        if (options->to != format.name) continue;
        const RecordedRun run = open_recorded_run(options->run);
        const std::filesystem::path out = options->out.empty() ? options->run / format.default_out : options->out;
        create_folder_of(out);
        Told told = {{"written", out.string()}};
        format.write(run, out, *options, told);
        fmt::print("{}", options->json ? json_text(told) : out.string() + "\n");
      }
      return static_cast<int>(ExitCode::done);
    };
  });
}

}  // namespace gracilis
