#include <gracilis/io/run/frame_times.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/cache_file.hpp>
#include <gracilis/scene/names.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace gracilis {
namespace {

constexpr std::string_view format = "gracilis frame time 1";

double vertices_of(const Scene& scene) {
  double count = 0;
  for (const Muscle& muscle : scene.muscles) count += static_cast<double>(muscle.surface.vertex_count());
  return count;
}

/// A file for each size of scenes, by powers of two: what a vertex takes in a small scene is mostly what a frame takes
/// anyhow.
std::filesystem::path file_of(const std::filesystem::path& cache, const FrameCost& cost, double vertices) {
  return cache / "times" /
         file_name_of(fmt::format("{}_{}_{}_{}.txt", cost.method, cost.preset, cost.threads, std::ilogb(vertices)));
}

}  // namespace

void remember_frame_time(const std::filesystem::path& cache, const FrameCost& cost, const Scene& scene,
                         double seconds) {
  const double vertices = vertices_of(scene);
  if (cache.empty() || !(vertices > 0) || !(seconds > 0)) return;
  const std::filesystem::path file = file_of(cache, cost, vertices);
  try {
    create_folder_of(file);
    write_cache_file(file, format, fmt::format("{}\n", seconds / vertices));
  } catch (const Error&) {
    // Later runs do without.
  }
}

std::optional<double> remembered_frame_time(const std::filesystem::path& cache, const FrameCost& cost,
                                            const Scene& scene) {
  const double vertices = vertices_of(scene);
  if (cache.empty() || !(vertices > 0)) return std::nullopt;
  const std::optional<std::string> kept = read_cache_file(file_of(cache, cost, vertices), format, {});
  if (!kept) return std::nullopt;
  const double seconds = std::strtod(kept->c_str(), nullptr) * vertices;
  return std::isfinite(seconds) && seconds > 0 ? std::optional(seconds) : std::nullopt;
}

}  // namespace gracilis
