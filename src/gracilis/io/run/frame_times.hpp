#pragma once

#include <gracilis/scene/scene.hpp>

#include <filesystem>
#include <optional>

namespace gracilis {

/// What tells how long frames of a scene take, besides how many vertices its muscles have.
struct FrameCost {
  std::string method;
  std::string preset;
  int threads = 1;
};

/// Keeps for later runs on this machine how long a frame took, s, by vertices of muscles. A folder that cannot be
/// written, or none, keeps nothing.
void remember_frame_time(const std::filesystem::path& cache, const FrameCost& cost, const Scene& scene, double seconds);

/// About how long a frame takes, s, by what the last run of this kind took for each vertex; nothing where there was
/// none of a scene of about this size, or where what is kept of it is damaged.
std::optional<double> remembered_frame_time(const std::filesystem::path& cache, const FrameCost& cost,
                                            const Scene& scene);

}  // namespace gracilis
