#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace gracilis {

/// Puts arrays on cache-line boundaries, so that no vector load of the solver's tables straddles two lines.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::size_t alignment = 64;

  AlignedAllocator() = default;
  /// Allocators have no state, so any is as good as any other.
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}

  /// Room for `count` items. Throws std::bad_alloc.
  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), std::align_val_t(alignment)));
  }
  /// What `allocate` gave.
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, std::align_val_t(alignment)); }

  /// Always: each can free what another one gave.
  template <class U>
  bool operator==(const AlignedAllocator<U>&) const {
    return true;
  }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace gracilis
