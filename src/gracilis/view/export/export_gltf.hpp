#pragma once

#include <gracilis/view/export/animated_run.hpp>

#include <filesystem>

namespace gracilis {

/// One .glb (glTF 2.0) that plays: muscles as morph targets, one for each frame, of which one at a time has weight 1,
/// blended in between; bones as nodes that turn and move. In m, the subject upright (y up) and looking along +z, as
/// glTF wants it. Throws InputError.
void export_gltf(const RecordedRun& run, const std::filesystem::path& path, const AnimationOptions& options = {});

}  // namespace gracilis
