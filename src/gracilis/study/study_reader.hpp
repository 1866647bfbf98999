#pragma once

#include <gracilis/study/study.hpp>

namespace gracilis {

/// Reads a study: a .toml (docs/guide/studies.md has every key), or a .csv with a run per row and a column per key.
/// Scenes are not looked at. Throws ConfigurationError with every problem of the description, InputError where a file
/// cannot be read.
Study read_study(const std::filesystem::path& file);

}  // namespace gracilis
