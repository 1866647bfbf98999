#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <filesystem>

namespace gracilis {

/// Reads a model, closes the loops of its default pose, and warns of everything in it that is left out; with `strict`
/// that is an error (exit code 4).
opensim::Model read_opensim_model(const std::filesystem::path& path, bool strict);

/// Closes the loops of the default pose with these coordinates held; warns where they stay open.
void close_default_pose(opensim::Model& model, const std::vector<bool>& held = {});

/// Warns of what `model` leaves out, from the `first` entry on; with `strict` throws.
void report_unsupported(const opensim::Model& model, std::size_t first, bool strict);

}  // namespace gracilis
