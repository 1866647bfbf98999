#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <utility>

namespace gracilis {

/// `value` as an integer between `least` and `most`; nothing where it is not whole, not finite or out of that range.
/// Whatever comes from a file and becomes an index or a size goes through this: a plain cast would wrap around.
template <std::integral To, class From>
std::optional<To> whole_number(From value, To least = std::numeric_limits<To>::min(),
                               To most = std::numeric_limits<To>::max()) {
  if constexpr (std::floating_point<From>) {
    // 64 bits of mantissa hold every integer of 64 bits.
    const auto exact = static_cast<long double>(value);
    if (!std::isfinite(value) || std::trunc(value) != value) return std::nullopt;
    if (exact < static_cast<long double>(least) || exact > static_cast<long double>(most)) return std::nullopt;
  } else if (std::cmp_less(value, least) || std::cmp_greater(value, most)) {
    return std::nullopt;
  }
  return static_cast<To>(value);
}

}  // namespace gracilis
