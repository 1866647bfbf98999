#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// The widest group of constraints or particles that is taken at once, whatever the machine's registers hold.
inline constexpr Index group_width = 16;

}  // namespace gracilis
