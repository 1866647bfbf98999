#include "fibers_command.hpp"

#include "scene_options.hpp"

#include <gracilis/anatomy/fibers/fiber_containment.hpp>
#include <gracilis/anatomy/fibers/muscle_fibers.hpp>
#include <gracilis/anatomy/fibers/surface_fibers.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/io/mesh/polyline_file.hpp>
#include <gracilis/view/pictures/fiber_picture.hpp>
#include <gracilis/view/pictures/muscle_colors.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>

namespace gracilis {

static std::vector<Real> in_degrees(std::vector<Real> angles) {
  for (Real& angle : angles) angle = degrees(angle);
  return angles;
}

static void describe(const Muscle& muscle, const Polylines& fibers, const FiberMeasures& measures) {
  if (fibers.count() == 0) {
    fmt::print("{}: no fibers\n", muscle.name);
    return;
  }
  const auto [shortest, longest] = std::minmax_element(measures.lengths.begin(), measures.lengths.end());
  const auto mean = [](const std::vector<Real>& values) {
    Real sum = 0;
    for (const Real value : values) sum += value;
    return sum / Real(values.size());
  };
  const Containment inside = containment(SignedDistance(muscle.surface), fibers);
  const Real volume = enclosed_volume(muscle.surface.vertices, muscle.surface.faces);
  fmt::print(
      "{}: {} fibers, {:.1f} mm long on average ({:.1f} to {:.1f}), pennation {:.1f}° at the origin and {:.1f}° at the "
      "insertion, physiological cross-section {:.2f} cm², {:.2f} % of the points outside by up to {:.3f} mm\n",
      muscle.name, fibers.count(), 1e3 * mean(measures.lengths), 1e3 * *shortest, 1e3 * *longest,
      degrees(mean(measures.origin_pennation)), degrees(mean(measures.insertion_pennation)),
      1e4 * physiological_cross_section(volume, fibers), 100.0 * inside.outside / std::max(inside.points, 1),
      1e3 * inside.farthest);
}

/// Writes the fibers carried onto the surface, and says how well they cover it.
static void write_surface_fibers(const Muscle& muscle, const Polylines& fibers, const std::filesystem::path& out) {
  if (fibers.count() == 0) return;
  for (const SurfacePaths kind : {SurfacePaths::along_fibers, SurfacePaths::nearest_joined}) {
    const SurfaceFibers found = surface_fibers(muscle, fibers, kind);
    const std::size_t edges = found.segments.size() + static_cast<std::size_t>(found.rejected);
    const bool published = kind == SurfacePaths::nearest_joined;
    fmt::print(
        "  on the surface, {}: {} segments, {:.1f} % rejected as more than 60° off, {:.0f} % of the surface covered\n",
        published ? "nearest vertices joined" : "along the fibers", found.segments.size(),
        100.0 * found.rejected / std::max<std::size_t>(edges, 1), 100 * found.coverage);
    if (published) continue;
    std::vector<Points> lines;
    LineScalars shared{"fibers", {}};
    for (const FiberSegment& segment : found.segments) {
      lines.emplace_back(3, 2);
      lines.back() << muscle.surface.vertices.col(segment.a), muscle.surface.vertices.col(segment.b);
      shared.values.push_back(segment.fibers);
    }
    write_polylines(out / (muscle.name + "_surface_fibers.vtp"), join(lines), {shared});
  }
}

static void draw(const Scene& scene, const std::vector<Polylines>& fibers, const std::filesystem::path& out) {
  try {
    render_picture(all_fibers_picture(scene, fibers), out / "fibers.png");
    for (std::size_t i = 0; i < scene.muscles.size(); ++i) {
      render_picture(muscle_fiber_picture(scene.muscles[i], fibers[i], muscle_color(scene.muscles[i].name)),
                     out / (scene.muscles[i].name + "_fibers.png"));
    }
  } catch (const Error& error) {
    if (error.code() != ExitCode::unsupported) throw;
    spdlog::warn("no picture: {}", error.what());
  }
}

static int write_fibers(const LoadedScene& loaded, const std::filesystem::path& out) {
  for (const std::string& warning : loaded.warnings) spdlog::warn("{}", warning);
  std::error_code error;
  std::filesystem::create_directories(out, error);
  std::vector<Polylines> fibers;
  for (const Muscle& muscle : loaded.scene.muscles) {
    fibers.push_back(fibers_of(muscle));
    const FiberMeasures measures = measure_fibers(fibers.back());
    describe(muscle, fibers.back(), measures);
    write_polylines(out / (muscle.name + "_fibers.vtp"), fibers.back(),
                    {{"length_m", measures.lengths},
                     {"origin_pennation_deg", in_degrees(measures.origin_pennation)},
                     {"insertion_pennation_deg", in_degrees(measures.insertion_pennation)}});
    write_surface_fibers(muscle, fibers.back(), out);
  }
  draw(loaded.scene, fibers, out);
  return static_cast<int>(ExitCode::done);
}

void add_fibers_command(CLI::App& program, Command& chosen) {
  struct Options {
    std::filesystem::path file, out;
    SceneOptions scene;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("fibers", "Write the fibers of a scene's muscles with lengths, pennation and pictures");
  add_scene_options(*command, options->file, options->scene);
  command->add_option("--out", options->out, "Folder to write")->required();
  command->callback([&chosen, options] {
    chosen = [options] { return write_fibers(read_scene(options->file, options->scene), options->out); };
  });
}

}  // namespace gracilis
