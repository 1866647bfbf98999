#pragma once

#include <gracilis/core/state_hash.hpp>
#include <gracilis/scene/frame.hpp>

#include <cstdint>

namespace gracilis {

/// Of the bits of all muscles' points.
inline std::uint64_t hash_of_shapes(const Frame& frame) {
  std::uint64_t hash = hash_seed;
  for (const MuscleShape& muscle : frame.muscles) hash = hash_of(muscle.points, hash);
  return hash;
}

}  // namespace gracilis
