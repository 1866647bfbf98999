#include <gracilis/scene/preparation.hpp>

#include <algorithm>

namespace gracilis {

std::vector<std::string> pull_only(std::vector<NamedSurface>& muscles, const std::vector<std::string>& apart) {
  if (apart.empty()) return {};
  const auto find = [&](const std::string& name) {
    return std::find_if(muscles.begin(), muscles.end(), [&](const NamedSurface& each) { return each.name == name; });
  };
  for (NamedSurface& muscle : muscles) muscle.apart_from.emplace();
  std::vector<std::string> unknown, from_all;
  for (const std::string& text : apart) {
    const std::size_t colon = text.find(':');
    if (find(text) != muscles.end() || colon == std::string::npos) {
      from_all.push_back(text);
      continue;
    }
    const std::string first = text.substr(0, colon), second = text.substr(colon + 1);
    for (const auto& [one, other] : {std::pair(first, second), std::pair(second, first)})
      if (const auto muscle = find(one); muscle == muscles.end())
        unknown.push_back(one);
      else
        muscle->apart_from->push_back(other);
  }
  for (const std::string& name : from_all)
    if (const auto muscle = find(name); muscle == muscles.end())
      unknown.push_back(name);
    else
      muscle->apart_from.reset();
  return unknown;
}

}  // namespace gracilis
