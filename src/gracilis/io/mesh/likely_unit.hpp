#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

struct LengthUnit {
  const char* name;  ///< as scene files and --unit have it
  Real length;       ///< m
};

/// In which unit the surfaces of a body are whose longest is so long in it: a part of a body is at most 2 m long, and
/// the longest of those that somebody has at least 2 cm.
inline LengthUnit likely_unit(Real longest) {
  if (longest <= 2) return {"m", 1};
  return longest < 20 ? LengthUnit{"cm", 0.01} : LengthUnit{"mm", 0.001};
}

}  // namespace gracilis
