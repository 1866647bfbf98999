#include <gracilis/dynamics/coloring.hpp>

#include <algorithm>
#include <set>

namespace gracilis {

namespace {

/// Which constraints touch a particle, as offset + index.
struct Incidence {
  std::vector<Index> offsets, constraints;
};

Incidence incidence_of(const ConstraintGraph& graph) {
  Incidence incidence;
  incidence.offsets.assign(static_cast<std::size_t>(graph.particle_count) + 1, 0);
  for (Index particle : graph.particles) ++incidence.offsets[static_cast<std::size_t>(particle) + 1];
  for (std::size_t p = 1; p < incidence.offsets.size(); ++p) incidence.offsets[p] += incidence.offsets[p - 1];
  incidence.constraints.resize(graph.particles.size());
  std::vector<Index> next(incidence.offsets.begin(), incidence.offsets.end() - 1);
  for (std::size_t i = 0; i < graph.particles.size(); ++i)
    incidence.constraints[static_cast<std::size_t>(next[static_cast<std::size_t>(graph.particles[i])]++)] =
        static_cast<Index>(i) / graph.arity;
  return incidence;
}

/// Neighbors of each constraint: those that share a particle with it.
Incidence conflicts_of(const ConstraintGraph& graph) {
  const Incidence incidence = incidence_of(graph);
  Incidence conflicts;
  conflicts.offsets.push_back(0);
  std::vector<Index> last_seen(static_cast<std::size_t>(graph.constraint_count()), -1);
  for (Index c = 0; c < graph.constraint_count(); ++c) {
    last_seen[static_cast<std::size_t>(c)] = c;
    for (int k = 0; k < graph.arity; ++k) {
      const auto p = static_cast<std::size_t>(graph.particles[static_cast<std::size_t>(c * graph.arity + k)]);
      for (Index i = incidence.offsets[p]; i < incidence.offsets[p + 1]; ++i) {
        const Index other = incidence.constraints[static_cast<std::size_t>(i)];
        if (last_seen[static_cast<std::size_t>(other)] == c) continue;
        last_seen[static_cast<std::size_t>(other)] = c;
        conflicts.constraints.push_back(other);
      }
    }
    conflicts.offsets.push_back(static_cast<Index>(conflicts.constraints.size()));
  }
  return conflicts;
}

/// Repeatedly takes away a constraint with the fewest remaining conflicts; the coloring order is the reverse.
std::vector<Index> smallest_last_order(const Incidence& conflicts) {
  const auto count = conflicts.offsets.size() - 1;
  std::vector<Index> degree(count);
  std::vector<std::vector<Index>> buckets;
  for (std::size_t c = 0; c < count; ++c) {
    degree[c] = conflicts.offsets[c + 1] - conflicts.offsets[c];
    if (buckets.size() <= static_cast<std::size_t>(degree[c])) buckets.resize(static_cast<std::size_t>(degree[c]) + 1);
    buckets[static_cast<std::size_t>(degree[c])].push_back(static_cast<Index>(c));
  }
  std::vector<char> taken(count, 0);
  std::vector<Index> order;
  order.reserve(count);
  std::size_t lowest = 0;
  while (order.size() < count) {
    while (buckets[lowest].empty()) ++lowest;
    const Index c = buckets[lowest].back();
    buckets[lowest].pop_back();
    // A constraint stays in its old buckets when its degree drops; those entries are stale.
    if (taken[static_cast<std::size_t>(c)] || static_cast<std::size_t>(degree[static_cast<std::size_t>(c)]) != lowest)
      continue;
    taken[static_cast<std::size_t>(c)] = 1;
    order.push_back(c);
    for (Index i = conflicts.offsets[static_cast<std::size_t>(c)];
         i < conflicts.offsets[static_cast<std::size_t>(c) + 1]; ++i) {
      const auto other = static_cast<std::size_t>(conflicts.constraints[static_cast<std::size_t>(i)]);
      if (taken[other]) continue;
      --degree[other];
      buckets[static_cast<std::size_t>(degree[other])].push_back(static_cast<Index>(other));
      lowest = std::min(lowest, static_cast<std::size_t>(degree[other]));
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

std::vector<Index> color_constraints(const ConstraintGraph& graph) {
  if (graph.particles.empty()) return {};
  const Incidence conflicts = conflicts_of(graph);
  std::vector<Index> colors(static_cast<std::size_t>(graph.constraint_count()), -1);
  std::vector<Index> used_by;  // per color: the last constraint that found it taken
  for (Index c : smallest_last_order(conflicts)) {
    for (Index i = conflicts.offsets[static_cast<std::size_t>(c)];
         i < conflicts.offsets[static_cast<std::size_t>(c) + 1]; ++i) {
      const Index color = colors[static_cast<std::size_t>(conflicts.constraints[static_cast<std::size_t>(i)])];
      if (color >= 0) used_by[static_cast<std::size_t>(color)] = c;
    }
    Index color = 0;
    while (color < static_cast<Index>(used_by.size()) && used_by[static_cast<std::size_t>(color)] == c) ++color;
    if (color == static_cast<Index>(used_by.size())) used_by.push_back(-1);
    colors[static_cast<std::size_t>(c)] = color;
  }
  return colors;
}

std::vector<std::vector<Index>> rounds_of(const std::vector<std::array<Index, 2>>& pairs) {
  std::vector<std::vector<Index>> rounds;
  std::vector<std::set<Index>> taken;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    std::size_t round = 0;
    while (round < taken.size() && (taken[round].count(pairs[i][0]) || taken[round].count(pairs[i][1]))) ++round;
    if (round == taken.size()) taken.emplace_back(), rounds.emplace_back();
    taken[round].insert({pairs[i][0], pairs[i][1]});
    rounds[round].push_back(static_cast<Index>(i));
  }
  return rounds;
}

}  // namespace gracilis
