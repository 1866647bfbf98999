#pragma once

#include <gracilis/core/types.hpp>

#include <cstddef>
#include <cstdint>

/// Fingerprints of states, to say "the same bits" in one number.
namespace gracilis {

inline constexpr std::uint64_t hash_seed = 14695981039346656037u;

/// FNV-1a (Fowler, Noll, Vo) over bytes.
inline std::uint64_t hash_bytes(const void* data, std::size_t size, std::uint64_t hash = hash_seed) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
  return hash;
}

/// Of the bytes of a contiguous array, going on from `hash`.
template <class Values>
std::uint64_t hash_of(const Values& values, std::uint64_t hash = hash_seed) {
  return hash_bytes(values.data(), static_cast<std::size_t>(values.size()) * sizeof(*values.data()), hash);
}

}  // namespace gracilis
