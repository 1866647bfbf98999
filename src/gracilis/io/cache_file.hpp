#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace gracilis {

/// Told what somebody should know.
using WarnFunction = std::function<void(const std::string&)>;

/// `size` bytes from `data` on.
inline std::string bytes_of(const void* data, std::size_t size) { return {static_cast<const char*>(data), size}; }

/// Writes a file of the cache: the format's name, a checksum over the file's own name and the content, the content.
/// Processes on any machines may write the same file at once. Throws InputError.
void write_cache_file(const std::filesystem::path& path, std::string_view format, const std::string& content);

/// What write_cache_file wrote there. Nothing where there is no such file; nothing, and a warning, where a bit of it
/// has changed, it was cut off or renamed, or cannot be read.
std::optional<std::string> read_cache_file(const std::filesystem::path& path, std::string_view format,
                                           const WarnFunction& warn);

/// Warns that a file of the cache is not used, and why.
void warn_of_cache_file(const std::filesystem::path& path, const std::string& why, const WarnFunction& warn);

}  // namespace gracilis
