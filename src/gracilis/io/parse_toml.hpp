#pragma once

#include <toml++/toml.h>

#include <string>

namespace gracilis {

/// A TOML text as a table; `source` is its file, for messages. Throws toml::parse_error where it is none, and
/// ConfigurationError where a key as a.b.c has more than 16 parts: tables that lie so deep are walked through by
/// functions that call themselves as often. (Arrays and tables in braces are counted by the parser.)
toml::table parse_toml(const std::string& text, const std::string& source);

/// The same of what a person wrote: where it is no TOML, a ConfigurationError names file, line and column, and what to
/// do.
toml::table parse_written_toml(const std::string& text, const std::string& source,
                               const std::string& advice = "correct the line");

}  // namespace gracilis
