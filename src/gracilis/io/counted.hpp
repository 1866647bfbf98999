#pragma once

#include <cstddef>
#include <string>

namespace gracilis {

/// A number with what it counts: "1 bone", "2 bones". `noun` is one whose plural ends in s.
inline std::string counted(std::size_t number, const std::string& noun) {
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

}  // namespace gracilis
