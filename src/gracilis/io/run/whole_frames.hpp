#pragma once

#include <gracilis/scene/scene.hpp>

#include <filesystem>

namespace gracilis {

/// How many frames, counted from 0, are whole in a run folder: a surface of every muscle and bone, exactly one row of
/// measures for every muscle and, for muscles whose measures tell of fibers, these and the row of their lengths.
int count_frames(const std::filesystem::path& folder, const Scene& scene);

}  // namespace gracilis
