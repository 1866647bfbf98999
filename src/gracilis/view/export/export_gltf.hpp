#pragma once

#include <gracilis/io/run/recorded_run.hpp>

#include <filesystem>

namespace gracilis {

struct GltfOptions {
  Index muscle_vertices = 4000;  ///< about, at most, of each muscle; they are some of its own
  Index bone_vertices = 4000;
  int frames = 60;              ///< at most; first, last and as many between as are allowed
  Real frames_per_second = 20;  ///< of the animation
};

/// One .glb (glTF 2.0) that plays: muscles as morph targets, one for each frame, of which one at a time has weight 1,
/// blended in between; bones as nodes that turn and move. In m, the subject upright (y up) and looking along +z, as
/// glTF wants it. Throws InputError.
void export_gltf(const RecordedRun& run, const std::filesystem::path& path, const GltfOptions& options = {});

}  // namespace gracilis
