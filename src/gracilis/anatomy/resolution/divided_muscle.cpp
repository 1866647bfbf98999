#include <gracilis/anatomy/resolution/divided_muscle.hpp>

#include <gracilis/core/parallel.hpp>

#include <utility>

namespace gracilis {

std::vector<VerticesBetween> divide_needles(std::vector<Muscle>& muscles) {
  std::vector<VerticesBetween> added(muscles.size());
  parallel_for_each(muscles.size(), [&](std::size_t m) {
    TriangleMesh& surface = muscles[m].surface;
    added[m].first = surface.vertex_count();
    const bool is_made_of_sections = muscles[m].action_line.rays > 0;
    if (is_made_of_sections || !has_needles(surface)) return;
    DividedNeedles divided = divide_needles(surface);
    surface = std::move(divided.mesh);
    added[m].ends = std::move(divided.ends);
  });
  return added;
}

void add_vertices_between(const VerticesBetween& added, std::vector<Index>& vertices) {
  std::vector<char> is_there(static_cast<std::size_t>(added.first) + added.ends.size(), 0);
  for (const Index v : vertices) is_there[static_cast<std::size_t>(v)] = 1;
  for (std::size_t i = 0; i < added.ends.size(); ++i) {
    const auto [a, b] = added.ends[i];
    const Index v = added.first + static_cast<Index>(i);
    if (is_there[static_cast<std::size_t>(v)]) continue;
    if (!is_there[static_cast<std::size_t>(a)] || !is_there[static_cast<std::size_t>(b)]) continue;
    is_there[static_cast<std::size_t>(v)] = 1;
    vertices.push_back(v);
  }
}

}  // namespace gracilis
