#pragma once

namespace gracilis {

inline constexpr float mm = 0.001f;  ///< m

}  // namespace gracilis
