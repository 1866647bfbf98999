#pragma once

#include <gracilis/dynamics/contact/mesh/contact_surface.hpp>

#include <map>
#include <queue>
#include <utility>
#include <vector>

namespace gracilis {

/// Spreads values from particles over a surface's edges, the least first (Dijkstra 1959): of a particle that has
/// `value` each neighbor has `value + growth(particle, neighbor)`, unless it has less from elsewhere, as long as that
/// is below limit(neighbor). Calls act(particle, value) once for each particle that has a value. Growth must not be
/// negative.
template <class Growth, class Limit, class Act>
void spread_along_edges(const ContactSurface& surface, const std::vector<std::pair<float, Index>>& sources,
                        const Growth& growth, const Limit& limit, const Act& act) {
  using Item = std::pair<float, Index>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> open(sources.begin(), sources.end());
  std::map<Index, float> reached;
  while (!open.empty()) {
    const auto [value, particle] = open.top();
    open.pop();
    if (!reached.emplace(particle, value).second) continue;
    act(particle, value);
    for_each_neighbor(surface, particle, [&, value = value, particle = particle](Index neighbor) {
      const float there = value + growth(particle, neighbor);
      if (there < limit(neighbor) && !reached.contains(neighbor)) open.emplace(there, neighbor);
    });
  }
}

}  // namespace gracilis
