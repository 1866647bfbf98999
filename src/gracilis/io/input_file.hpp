#pragma once

#include <filesystem>
#include <string>

namespace gracilis {

/// Throws InputError unless `path` is a regular file that is not empty and may be read.
void require_readable_file(const std::filesystem::path& path);

/// What to do with a folder that holds a run where something else is asked for.
std::string run_folder_advice(const std::filesystem::path& folder);

/// The whole file as bytes. Throws InputError as above.
std::string read_text(const std::filesystem::path& path);

/// Whether something stands at `path`. Throws InputError where the system does not tell, as without a right to look.
bool is_there(const std::filesystem::path& path);

/// The whole file; nothing where it is missing or empty, as an interruption may leave what grows line by line. Throws
/// InputError where it is there and cannot be read.
std::string text_if_there(const std::filesystem::path& path);

/// ".PLY" becomes ".ply".
std::string lower_case_extension(const std::filesystem::path& path);

}  // namespace gracilis
