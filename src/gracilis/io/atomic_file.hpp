#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace gracilis {

/// Writes a file that appears whole or not at all: `write` fills a temporary file beside `path` (same extension), which
/// is then synced and renamed. On any failure the temporary is removed, what stood at `path` is untouched, and Error is
/// thrown with the path and the system's reason.
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(const std::filesystem::path&)>& write);

/// The same for a text already in memory.
void write_text_atomically(const std::filesystem::path& path, const std::string& text);

}  // namespace gracilis
