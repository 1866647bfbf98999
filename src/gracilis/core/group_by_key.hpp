#pragma once

#include <gracilis/core/types.hpp>

#include <numeric>
#include <span>
#include <vector>

namespace gracilis {

/// The numbers of items by their keys: those with key k are items[begins[k]] ... items[begins[k + 1] - 1], ascending.
struct GroupedByKey {
  std::vector<Index> begins, items;

  /// The items with this key. Precondition: it is one of those that were grouped by.
  std::span<const Index> with(Index key) const {
    const auto k = static_cast<std::size_t>(key);
    return {items.begin() + begins[k], items.begin() + begins[k + 1]};
  }
};

/// By counting. Precondition: keys are from 0 to key_count - 1.
inline GroupedByKey group_by_key(std::span<const Index> keys, Index key_count) {
  GroupedByKey groups;
  groups.begins.assign(static_cast<std::size_t>(key_count) + 1, 0);
  for (const Index key : keys) ++groups.begins[static_cast<std::size_t>(key) + 1];
  std::partial_sum(groups.begins.begin(), groups.begins.end(), groups.begins.begin());
  std::vector<Index> next(groups.begins.begin(), groups.begins.end() - 1);
  groups.items.resize(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
    groups.items[static_cast<std::size_t>(next[static_cast<std::size_t>(keys[i])]++)] = static_cast<Index>(i);
  return groups;
}

}  // namespace gracilis
