#pragma once

#include <filesystem>
#include <string>

namespace gracilis {

/// Throws InputError unless `path` is a regular file that is not empty and may be read.
void require_readable_file(const std::filesystem::path& path);

/// The whole file as bytes. Throws InputError as above.
std::string read_text(const std::filesystem::path& path);

/// ".PLY" becomes ".ply".
std::string lower_case_extension(const std::filesystem::path& path);

}  // namespace gracilis
