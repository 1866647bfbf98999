#pragma once

#include <gracilis/anatomy/builtin/builtin_hip.hpp>

namespace gracilis {

/// The built-in hip, shaped once for all tests of a process: it takes seconds.
inline const Scene& shaped_hip() {
  static const Scene scene = builtin_hip();
  return scene;
}

}  // namespace gracilis
