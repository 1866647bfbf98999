#include <gracilis/io/json_file.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>

#include <fmt/format.h>

namespace gracilis {

static constexpr int deepest = 64;

/// Brackets outside of texts are counted before anything is built.
static void require_shallow(const std::filesystem::path& path, const std::string& text) {
  int depth = 0, line = 1;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') ++line;
    if (in_text && c == '\\') ++i;
    if (c == '"') in_text = !in_text;
    if (in_text) continue;
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > deepest)
      throw InputError({path.string(), std::to_string(line), fmt::format("is nested more than {} times", deepest),
                        "is it the right file?"});
  }
}

nlohmann::ordered_json read_json(const std::filesystem::path& path) { return parse_json(path, read_text(path)); }

nlohmann::ordered_json parse_json(const std::filesystem::path& path, const std::string& text) {
  require_shallow(path, text);
  try {
    return nlohmann::ordered_json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw InputError({path.string(), "", std::string("is not JSON: ") + error.what(), "write it again"});
  }
}

std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace gracilis
