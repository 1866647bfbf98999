#include "fibers_command.hpp"

#include "scene_options.hpp"

#include <gracilis/anatomy/fibers/fiber_containment.hpp>
#include <gracilis/anatomy/fibers/muscle_fibers.hpp>
#include <gracilis/anatomy/fibers/surface_fibers.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/mesh/polyline_file.hpp>
#include <gracilis/view/pictures/fiber_picture.hpp>
#include <gracilis/view/pictures/muscle_colors.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <numeric>

namespace gracilis {

static std::vector<Real> in_degrees(std::vector<Real> angles) {
  for (Real& angle : angles) angle = degrees(angle);
  return angles;
}

static Real mean(const std::vector<Real>& values) {
  return std::accumulate(values.begin(), values.end(), Real(0)) / Real(values.size());
}

/// What is known of a muscle's fibers.
static nlohmann::ordered_json description(const Muscle& muscle, const Polylines& fibers,
                                          const FiberMeasures& measures) {
  nlohmann::ordered_json told = {{"muscle", muscle.name}, {"fibers", fibers.count()}};
  if (fibers.count() == 0) return told;
  const auto [shortest, longest] = std::minmax_element(measures.lengths.begin(), measures.lengths.end());
  const Containment inside = containment(SignedDistance(muscle.surface), fibers);
  const Real volume = enclosed_volume(muscle.surface.vertices, muscle.surface.faces);
  told["mean_length_m"] = mean(measures.lengths);
  told["shortest_m"] = *shortest;
  told["longest_m"] = *longest;
  told["origin_pennation_deg"] = degrees(mean(measures.origin_pennation));
  told["insertion_pennation_deg"] = degrees(mean(measures.insertion_pennation));
  told["physiological_cross_section_m2"] = physiological_cross_section(volume, fibers);
  told["share_outside"] = Real(inside.outside) / std::max(inside.points, 1);
  told["farthest_outside_m"] = inside.farthest;
  return told;
}

/// The same as a sentence.
static std::string sentence(const nlohmann::ordered_json& told) {
  const std::string muscle = told["muscle"];
  if (told["fibers"] == 0) return muscle + ": no fibers";
  const auto value = [&](const char* key) { return told[key].get<Real>(); };
  return fmt::format(
      "{}: {} fibers, {:.1f} mm long on average ({:.1f} to {:.1f}), pennation {:.1f}° at the origin and {:.1f}° at the "
      "insertion, physiological cross-section {:.2f} cm², {:.2f} % of the points outside by up to {:.3f} mm",
      muscle, told["fibers"].get<Index>(), 1e3 * value("mean_length_m"), 1e3 * value("shortest_m"),
      1e3 * value("longest_m"), value("origin_pennation_deg"), value("insertion_pennation_deg"),
      1e4 * value("physiological_cross_section_m2"), 100 * value("share_outside"), 1e3 * value("farthest_outside_m"));
}

/// How well the fibers carried onto the surface cover it, by both ways to carry them.
static nlohmann::ordered_json surface_coverage(const Muscle& muscle, const Polylines& fibers) {
  nlohmann::ordered_json told = nlohmann::json::array();
  if (fibers.count() == 0) return told;
  for (const SurfacePaths kind : {SurfacePaths::along_fibers, SurfacePaths::nearest_joined}) {
    const SurfaceFibers found = surface_fibers(muscle, fibers, kind);
    const std::size_t edges = found.segments.size() + static_cast<std::size_t>(found.rejected);
    const bool published = kind == SurfacePaths::nearest_joined;
    told.push_back({{"carried", published ? "nearest vertices joined" : "along the fibers"},
                    {"segments", found.segments.size()},
                    {"share_rejected", Real(found.rejected) / Real(std::max<std::size_t>(edges, 1))},
                    {"share_covered", found.coverage}});
  }
  return told;
}

/// Those along which the muscle contracts by its settings; returns them as lines.
static Polylines write_surface_fibers(const Muscle& muscle, const std::filesystem::path& out) {
  const SurfaceFibers found = contracting_fibers(muscle);
  Polylines lines = segment_lines(found, muscle.surface.vertices);
  LineScalars shared{"fibers", {}};
  for (const FiberSegment& segment : found.segments) shared.values.push_back(segment.fibers);
  if (lines.count() > 0) write_polylines(out / (muscle.name + "_surface_fibers.vtp"), lines, {shared});
  return lines;
}

static void print(const nlohmann::ordered_json& told) {
  fmt::print("{}\n", sentence(told));
  for (const auto& carried : told["on_surface"])
    fmt::print(
        "  on the surface, {}: {} segments, {:.1f} % rejected as more than 60° off, {:.0f} % of the surface "
        "covered\n",
        carried["carried"].get<std::string>(), carried["segments"].get<std::size_t>(),
        100 * carried["share_rejected"].get<Real>(), 100 * carried["share_covered"].get<Real>());
}

/// NAME.png of all muscles, and MUSCLE_NAME.png of each.
static void draw(const Scene& scene, const std::vector<Polylines>& fibers, const std::filesystem::path& out,
                 const std::string& name) {
  try {
    render_picture(all_fibers_picture(scene, fibers), out / (name + ".png"));
    for (std::size_t i = 0; i < scene.muscles.size(); ++i) {
      render_picture(muscle_fiber_picture(scene.muscles[i], fibers[i], muscle_color(scene.muscles[i].name)),
                     out / (scene.muscles[i].name + "_" + name + ".png"));
    }
  } catch (const Error& error) {
    if (error.code() != ExitCode::unsupported) throw;
    spdlog::warn("no picture: {}", error.what());
  }
}

static int write_fibers(const LoadedScene& loaded, const std::filesystem::path& out, bool as_json) {
  for (const std::string& warning : loaded.warnings) spdlog::warn("{}", warning);
  std::error_code error;
  std::filesystem::create_directories(out, error);
  std::vector<Polylines> fibers, on_surface;
  nlohmann::ordered_json all = nlohmann::json::array();
  for (const Muscle& muscle : loaded.scene.muscles) {
    fibers.push_back(fibers_of(muscle));
    const FiberMeasures measures = measure_fibers(fibers.back());
    write_polylines(out / (muscle.name + "_fibers.vtp"), fibers.back(),
                    {{"length_m", measures.lengths},
                     {"origin_pennation_deg", in_degrees(measures.origin_pennation)},
                     {"insertion_pennation_deg", in_degrees(measures.insertion_pennation)}});
    all.push_back(description(muscle, fibers.back(), measures));
    all.back()["on_surface"] = surface_coverage(muscle, fibers.back());
    on_surface.push_back(write_surface_fibers(muscle, out));
    if (!as_json) print(all.back());
  }
  if (as_json) fmt::print("{}", json_text(all));
  draw(loaded.scene, fibers, out, "fibers");
  draw(loaded.scene, on_surface, out, "surface_fibers");
  return static_cast<int>(ExitCode::done);
}

void add_fibers_command(CLI::App& program, Command& chosen) {
  struct Options {
    std::filesystem::path file, out;
    SceneOptions scene;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("fibers", "Write the fibers of a scene's muscles with lengths, pennation and pictures");
  add_scene_options(*command, options->file, options->scene);
  command->add_option("--out", options->out, "Folder to write")->required();
  command->add_flag("--json", options->json, "Print a list with an object per muscle, for programs");
  command->callback([&chosen, options] {
    chosen = [options] { return write_fibers(read_scene(options->file, options->scene), options->out, options->json); };
  });
}

}  // namespace gracilis
