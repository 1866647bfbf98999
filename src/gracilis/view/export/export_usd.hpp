#pragma once

#include <gracilis/view/export/animated_run.hpp>

#include <filesystem>

namespace gracilis {

/// One .usda (the text form of OpenUSD) that plays: muscles as meshes whose points have time samples, bones as meshes
/// with a transform that has, fibers, where the run has them, as linear curves. In m, the subject upright (y up) and
/// looking along +z. Names of prims are made of those of the run; each keeps its own as `gracilis:name`. Throws
/// InputError.
void export_usd(const RecordedRun& run, const std::filesystem::path& path, const AnimationOptions& options = {});

}  // namespace gracilis
