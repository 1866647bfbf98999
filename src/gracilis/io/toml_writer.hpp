#pragma once

#include <toml++/toml.h>

#include <string>

namespace gracilis {

/// A table as TOML that people can read: lists of tables as [[...]], long lists of numbers over several lines of as
/// many as fit. Reads back the same.
std::string toml_of(const toml::table& table);

}  // namespace gracilis
