#include <gracilis/dynamics/constraints/color_order.hpp>

#include <gracilis/dynamics/particle_order.hpp>

#include <algorithm>

namespace gracilis {

namespace {

/// Constraints worth a task.
constexpr Index least_constraints = 2048;

/// The cluster that a constraint lies in as a whole, or `cluster_count` where it lies across several.
std::vector<Index> clusters_of(const ConstraintGraph& graph, Index cluster_count) {
  std::vector<Index> clusters;
  for (Index c = 0; c < graph.constraint_count(); ++c) {
    const auto first = graph.particles.begin() + static_cast<std::ptrdiff_t>(c) * graph.arity;
    const auto cluster_at = [&](Index particle) { return cluster_of(particle, graph.particle_count, cluster_count); };
    const Index cluster = cluster_at(*first);
    const bool whole = std::all_of(first, first + graph.arity, [&](Index p) { return cluster_at(p) == cluster; });
    clusters.push_back(whole ? cluster : cluster_count);
  }
  return clusters;
}

/// Lays out some of a graph's constraints: those of one color side by side, in an order that follows memory, each color
/// padded to whole groups with this idle particle.
void lay_out(const ConstraintGraph& graph, const std::vector<Index>& constraints, Index idle,
             ConstraintLayout& layout) {
  ConstraintGraph part{graph.arity, graph.particle_count, {}};
  for (const Index c : constraints)
    part.particles.insert(part.particles.end(), graph.particles.begin() + static_cast<std::ptrdiff_t>(c) * graph.arity,
                          graph.particles.begin() + static_cast<std::ptrdiff_t>(c + 1) * graph.arity);
  const std::vector<Index> colors = color_constraints(part);
  const Index color_count = colors.empty() ? 0 : *std::max_element(colors.begin(), colors.end()) + 1;
  std::vector<std::vector<Index>> members(static_cast<std::size_t>(color_count));
  for (std::size_t i = 0; i < colors.size(); ++i)
    members[static_cast<std::size_t>(colors[i])].push_back(constraints[i]);
  for (auto& color : members) {
    std::stable_sort(color.begin(), color.end(), [&](Index l, Index r) {
      return graph.particles[static_cast<std::size_t>(l * graph.arity)] <
             graph.particles[static_cast<std::size_t>(r * graph.arity)];
    });
    const auto begin = static_cast<Index>(layout.idle.size());
    for (std::size_t i = 0; i < color.size(); ++i)
      layout.slot[static_cast<std::size_t>(color[i])] = begin + static_cast<Index>(i);
    const Index end = begin + (static_cast<Index>(color.size()) + group_width - 1) / group_width * group_width;
    layout.idle.resize(static_cast<std::size_t>(end), idle);
    layout.order.colors.push_back({begin, end});
  }
}

}  // namespace

ConstraintLayout lay_out(const ConstraintGraph& graph) {
  const Index count = graph.constraint_count();
  const Index cluster_count =
      std::max<Index>(1, std::min(cluster_count_of(graph.particle_count), count / least_constraints));
  std::vector<std::vector<Index>> members(static_cast<std::size_t>(cluster_count) + 1);
  const std::vector<Index> clusters = clusters_of(graph, cluster_count);
  for (Index c = 0; c < count; ++c)
    members[static_cast<std::size_t>(clusters[static_cast<std::size_t>(c)])].push_back(c);
  ConstraintLayout layout;
  layout.slot.resize(static_cast<std::size_t>(count));
  for (Index cluster = 0; cluster < cluster_count; ++cluster) {
    lay_out(graph, members[static_cast<std::size_t>(cluster)], graph.particle_count + cluster, layout);
    layout.order.clusters.push_back(static_cast<Index>(layout.order.colors.size()));
  }
  lay_out(graph, members.back(), graph.particle_count, layout);
  return layout;
}

}  // namespace gracilis
