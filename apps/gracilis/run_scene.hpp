#pragma once

#include <gracilis/io/scene/scene_reader.hpp>

#include <filesystem>

namespace gracilis {

/// The scene that a run was made of, by the command line in its manifest. Throws ConfigurationError where that names
/// none, InputError where it cannot be read any more.
LoadedScene scene_of_run(const std::filesystem::path& run);

}  // namespace gracilis
