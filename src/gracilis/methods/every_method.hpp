#pragma once

#include <gracilis/methods/method_entry.hpp>

#include <vector>

namespace gracilis {

/// A row per method, the default first. The page in the browser has fewer (web/page_methods.cpp).
std::vector<MethodEntry> every_method();

}  // namespace gracilis
