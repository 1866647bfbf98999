#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace gracilis {

/// What a key does. The help is made of the same table, so it never says anything else.
struct KeyBinding {
  std::vector<std::string> keys;  ///< X's names
  std::string shown, meaning;     ///< in the help; empty: it is told with the one before
  std::function<void()> act;
};

/// Acts; true when there is such a key.
bool press_key(const std::vector<KeyBinding>& bindings, const std::string& key);

/// Key and meaning, in the table's order.
std::vector<std::pair<std::string, std::string>> help_rows(const std::vector<KeyBinding>& bindings);

}  // namespace gracilis
