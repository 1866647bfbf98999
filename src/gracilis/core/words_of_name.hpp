#pragma once

#include <algorithm>
#include <string>

namespace gracilis {

/// A name as pictures and plots show it: "gluteus_maximus_r" as "gluteus maximus r".
inline std::string words_of_name(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace gracilis
