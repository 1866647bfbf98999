#pragma once

#include <gracilis/core/types.hpp>

#include <string>

namespace gracilis {

/// Something that nobody said: what, how it was found, and how sure that is (0 to 1).
struct Guess {
  std::string subject, how;
  Real certainty = 0;
};

/// "how, certainty 0.85".
std::string to_string(const Guess& guess);

/// Below this a guess should be looked at first.
inline constexpr Real doubtful = 0.6;

}  // namespace gracilis
