#pragma once

#include <gracilis/io/scene/scene_in_progress.hpp>
#include <gracilis/io/toml_reader.hpp>

#include <filesystem>
#include <functional>
#include <string>

namespace gracilis::sections {

/// The length in m of the unit that stands under the key; 1 without the key.
Real unit_of(TomlReader& table, const std::string& key);

/// A file named in the table, whose unit stands under the key `unit`.
NamedFile named_file(TomlReader& table, const std::string& path);

/// The file that stands under the key, which says its units itself; an empty path without the key.
NamedFile file_at(TomlReader& table, const std::string& key);

/// The file beside the scene or in the data root; empty when it is in neither.
std::filesystem::path located(const SceneInProgress& progress, const NamedFile& file);

/// Hands the file's path to `read` and adds it to the scene's inputs; adds a problem when it is not there, and those
/// that `read` throws as an InputError.
void read_file(SceneInProgress& progress, const NamedFile& file,
               const std::function<void(const std::filesystem::path&)>& read);

}  // namespace gracilis::sections
