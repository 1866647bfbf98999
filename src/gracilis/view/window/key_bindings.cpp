#include <gracilis/view/window/key_bindings.hpp>

#include <algorithm>

namespace gracilis {

bool press_key(const std::vector<KeyBinding>& bindings, const std::string& key) {
  for (const KeyBinding& binding : bindings) {
    if (std::find(binding.keys.begin(), binding.keys.end(), key) == binding.keys.end()) continue;
    binding.act();
    return true;
  }
  return false;
}

std::vector<std::pair<std::string, std::string>> help_rows(const std::vector<KeyBinding>& bindings) {
  std::vector<std::pair<std::string, std::string>> rows;
  for (const KeyBinding& binding : bindings)
    if (!binding.shown.empty()) rows.emplace_back(binding.shown, binding.meaning);
  return rows;
}

}  // namespace gracilis
