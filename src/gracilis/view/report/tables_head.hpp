#pragma once

#include <string>

namespace gracilis {

/// How a page of tables begins, up to where its own rules of style go: what it may load, its title ("`title` · Gracilis
/// `kind`") and the style of tables.
std::string tables_head(const std::string& title, const std::string& kind);

}  // namespace gracilis
