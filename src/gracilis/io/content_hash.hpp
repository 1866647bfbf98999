#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gracilis {

/// SHA-256 of the file's bytes, 64 hexadecimal digits. Throws InputError when it cannot be read.
std::string content_hash(const std::filesystem::path& path);

/// The same of bytes in memory.
std::string content_hash_of(std::string_view bytes);

}  // namespace gracilis
