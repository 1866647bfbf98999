#include <gracilis/io/parse_toml.hpp>

#include <gracilis/core/errors.hpp>

#include <algorithm>

namespace gracilis {

/// The place behind the text in quotes that begins at `i`, or behind the last line of one that does not end.
static std::size_t end_of_quoted(const std::string& text, std::size_t i) {
  const char quote = text[i];
  const bool is_long = text.compare(i, 3, std::string(3, quote)) == 0;
  const std::string end(is_long ? 3 : 1, quote);
  for (i += end.size(); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (text.compare(i, end.size(), end) == 0) {
      i += end.size();
      while (is_long && i < text.size() && text[i] == quote) ++i;  // quotation marks may stand before the last three
      return i;
    } else if (text[i] == '\n' && !is_long) {
      return i;
    }
  }
  return text.size();
}

static void require_short_keys(const std::string& text, const std::string& source) {
  constexpr int most_parts = 16;
  int parts = 1;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = end_of_quoted(text, i);
      continue;
    }
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') parts = 1;
    ++i;
    if (c != '.' || ++parts <= most_parts) continue;
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n');
    throw ConfigurationError({source, std::to_string(line),
                              "a key has more than " + std::to_string(most_parts) + " parts",
                              "no setting lies so deep"});
  }
}

toml::table parse_toml(const std::string& text, const std::string& source) {
  require_short_keys(text, source);
  return toml::parse(text, source);
}

toml::table parse_written_toml(const std::string& text, const std::string& source, const std::string& advice) {
  try {
    return parse_toml(text, source);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw ConfigurationError({source, at ? std::to_string(at.line) + ":" + std::to_string(at.column) : "",
                              std::string(error.description()), advice});
  }
}

}  // namespace gracilis
