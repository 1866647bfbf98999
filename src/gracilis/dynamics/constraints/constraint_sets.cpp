#include <gracilis/dynamics/constraints/constraint_sets.hpp>

#include <gracilis/dynamics/coloring.hpp>
#include <gracilis/dynamics/face_fans.hpp>
#include <gracilis/dynamics/particle_order.hpp>

#include <algorithm>
#include <cassert>

namespace gracilis {

namespace {

/// Constraints worth a task.
constexpr Index least_constraints = 2048;

struct Layout {
  ColorOrder order;
  std::vector<Index> slot;
  Index size = 0;
};

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
/// padded to whole groups.
void lay_out(const ConstraintGraph& graph, const std::vector<Index>& constraints, Layout& layout) {
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
    const Index begin = layout.size;
    for (std::size_t i = 0; i < color.size(); ++i)
      layout.slot[static_cast<std::size_t>(color[i])] = begin + static_cast<Index>(i);
    layout.size = begin + (static_cast<Index>(color.size()) + group_width - 1) / group_width * group_width;
    layout.order.colors.push_back({begin, layout.size});
  }
}

Layout lay_out(const ConstraintGraph& graph) {
  const Index count = graph.constraint_count();
  const Index cluster_count =
      std::max<Index>(1, std::min(cluster_count_of(graph.particle_count), count / least_constraints));
  std::vector<std::vector<Index>> members(static_cast<std::size_t>(cluster_count) + 1);
  const std::vector<Index> clusters = clusters_of(graph, cluster_count);
  for (Index c = 0; c < count; ++c)
    members[static_cast<std::size_t>(clusters[static_cast<std::size_t>(c)])].push_back(c);
  Layout layout;
  layout.slot.resize(static_cast<std::size_t>(count));
  for (Index cluster = 0; cluster < cluster_count; ++cluster) {
    lay_out(graph, members[static_cast<std::size_t>(cluster)], layout);
    layout.order.clusters.push_back(static_cast<Index>(layout.order.colors.size()));
  }
  lay_out(graph, members.back(), layout);
  return layout;
}

}  // namespace

DistanceSet build_distance_set(const std::vector<DistanceConstraint>& constraints, Index particle_count) {
  ConstraintGraph graph{2, particle_count, {}};
  for (const DistanceConstraint& c : constraints) graph.particles.insert(graph.particles.end(), {c.a, c.b});
  Layout layout = lay_out(graph);
  DistanceSet set;
  const auto size = static_cast<std::size_t>(layout.size);
  set.a.assign(size, particle_count);
  set.b.assign(size, particle_count);
  set.rest_length.assign(size, 0);
  set.compliance.assign(size, 0);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const auto at = static_cast<std::size_t>(layout.slot[i]);
    set.a[at] = constraints[i].a;
    set.b[at] = constraints[i].b;
    set.rest_length[at] = static_cast<float>(constraints[i].rest_length);
    set.compliance[at] = static_cast<float>(constraints[i].compliance);
  }
  set.order = std::move(layout.order);
  set.slot = std::move(layout.slot);
  set.count = static_cast<Index>(constraints.size());
  return set;
}

HingeSet build_hinge_set(const std::vector<HingeConstraint>& constraints, Index particle_count) {
  ConstraintGraph graph{4, particle_count, {}};
  for (const HingeConstraint& c : constraints)
    graph.particles.insert(graph.particles.end(), c.particles.begin(), c.particles.end());
  Layout layout = lay_out(graph);
  HingeSet set;
  const auto size = static_cast<std::size_t>(layout.size);
  for (auto& column : set.particles) column.assign(size, particle_count);
  set.rest_angle.assign(size, 0);
  set.compliance.assign(size, 0);
  set.edge_length.assign(size, 0);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const auto at = static_cast<std::size_t>(layout.slot[i]);
    for (std::size_t k = 0; k < 4; ++k) set.particles[k][at] = constraints[i].particles[k];
    set.rest_angle[at] = static_cast<float>(constraints[i].rest_angle);
    set.compliance[at] = static_cast<float>(constraints[i].compliance);
    set.edge_length[at] = static_cast<float>(constraints[i].edge_length);
  }
  set.order = std::move(layout.order);
  set.count = static_cast<Index>(constraints.size());
  return set;
}

namespace {

/// Vertices sorted by the length of their rings stay within so many places of each other, so that a group's particles
/// are near each other in memory.
constexpr std::ptrdiff_t sorting_window = 16 * group_width;

/// The neighbors of a particle in turn, the first once more at the end; none where it has no faces.
void chain(const FaceFans& fans, Index particle, std::vector<Index>& ring) {
  ring.clear();
  const Index begin = fans.offsets[static_cast<std::size_t>(particle)];
  const auto count = static_cast<Index>(fans.around(particle).size());
  if (count == 0) return;
  // Each face says: after its first end comes its second.
  const auto after = [&](Index neighbor) {
    Index i = begin;
    while (i < begin + count && fans.ends(0, i) != neighbor) ++i;
    assert(i < begin + count && "the surface is not closed");
    return fans.ends(1, i);
  };
  Index next = fans.ends(0, begin);
  for (Index i = 0; i < count; ++i, next = after(next)) ring.push_back(next);
  ring.push_back(ring.front());
}

}  // namespace

VolumeSet build_volume_set(const Eigen::Matrix3Xi& faces, Index particle_count, Real target, Real compliance) {
  const FaceFans fans = build_face_fans(faces, particle_count);
  const auto face_count = [&](Index p) { return fans.around(p).size(); };
  std::vector<Index> order;
  for (Index p = 0; p < particle_count; ++p)
    if (face_count(p) > 0) order.push_back(p);
  for (auto begin = order.begin(); begin != order.end();) {
    const auto end = begin + std::min(sorting_window, order.end() - begin);
    std::stable_sort(begin, end, [&](Index l, Index r) { return face_count(l) < face_count(r); });
    begin = end;
  }
  const auto width = static_cast<std::size_t>(group_width);
  order.resize((order.size() + width - 1) / width * width, particle_count);

  VolumeSet set;
  set.target = target;
  set.compliance = compliance;
  set.particles.assign(order.begin(), order.end());
  set.ring_offsets.push_back(0);
  const auto steps_of = [&](std::size_t group) {
    std::size_t steps = 1;
    for (std::size_t lane = 0; lane < width; ++lane)
      if (order[group + lane] < particle_count) steps = std::max(steps, face_count(order[group + lane]) + 1);
    return steps;
  };
  std::size_t all_steps = 0;
  for (std::size_t group = 0; group < order.size(); group += width) all_steps += steps_of(group);
  set.ring.reserve(all_steps * width);
  std::array<std::vector<Index>, group_width> rings;
  for (std::size_t group = 0; group < order.size(); group += width) {
    const std::size_t steps = steps_of(group);
    for (std::size_t lane = 0; lane < width; ++lane) {
      const Index p = order[group + lane];
      if (p == particle_count)
        rings[lane] = {p};  // idle
      else
        chain(fans, p, rings[lane]);
    }
    for (std::size_t step = 0; step < steps; ++step)
      for (const std::vector<Index>& ring : rings) set.ring.push_back(ring[std::min(step, ring.size() - 1)]);
    set.ring_offsets.push_back(static_cast<Index>(set.ring.size() / width));
  }
  return set;
}

}  // namespace gracilis
