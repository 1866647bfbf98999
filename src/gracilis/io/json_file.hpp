#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace gracilis {

/// The file as JSON, its keys in their order. Throws InputError where it is none or nested more than 64 times: what
/// walks through it again calls itself for every level.
nlohmann::ordered_json read_json(const std::filesystem::path& path);

/// The same of a text that stands in the file.
nlohmann::ordered_json parse_json(const std::filesystem::path& path, const std::string& text);

/// JSON as text for a file, in indented lines. What is no UTF-8, as names of files may be, is replaced, so that the
/// text always is.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace gracilis
