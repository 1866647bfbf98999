#include <gracilis/dynamics/constraints/stretch_watch.hpp>

#include <algorithm>

namespace gracilis {

namespace {

/// How far the ends of an edge may part within one iteration: over the longest edge at either, as short edges go with
/// what moves the long ones beside them; and at most, m.
constexpr float reserve_share = 0.5f, largest_reserve = 0.002f;

/// Of each particle, the idle one too, the longest edge that ends there, m.
std::vector<float> longest_edges(const DistanceSet& set) {
  std::vector<float> longest;
  for (std::size_t slot = 0; slot < set.a.size(); ++slot)
    for (const Index end : {set.a[slot], set.b[slot]}) {
      const auto particle = static_cast<std::size_t>(end);
      if (longest.size() <= particle) longest.resize(particle + 1, 0);
      longest[particle] = std::max(longest[particle], set.rest_length[slot]);
    }
  return longest;
}

}  // namespace

void watch_stretch(const DistanceSet& set, float limit, StretchWatch& watch) {
  if (watch.limit == limit && watch.from.size() == set.a.size()) return;
  watch.limit = limit;
  watch.from.resize(set.a.size());
  watch.groups.assign(set.a.size() / group_width, 1);
  const std::vector<float> longest = longest_edges(set);
  for (std::size_t slot = 0; slot < set.a.size(); ++slot) {
    const float nearby =
        std::max(longest[static_cast<std::size_t>(set.a[slot])], longest[static_cast<std::size_t>(set.b[slot])]);
    watch.from[slot] = limit * set.rest_length[slot] - std::min(reserve_share * nearby, largest_reserve);
  }
}

void look_nowhere(StretchWatch& watch) { std::fill(watch.groups.begin(), watch.groups.end(), 0); }

void look_everywhere(StretchWatch& watch) { std::fill(watch.groups.begin(), watch.groups.end(), 1); }

}  // namespace gracilis
