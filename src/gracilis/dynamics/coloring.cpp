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

/// The constraints that share a particle with one, which is none of them. They are found anew each time: a list of all
/// would be larger than what is colored.
class Conflicts {
 public:
  explicit Conflicts(const ConstraintGraph& graph)
      : graph_(graph),
        incidence_(incidence_of(graph)),
        last_seen_(static_cast<std::size_t>(graph.constraint_count()), -1) {}

  Index constraint_count() const { return graph_.constraint_count(); }

  template <class See>
  void for_each(Index c, const See& see) {
    ++time_;
    last_seen_[static_cast<std::size_t>(c)] = time_;
    for (int k = 0; k < graph_.arity; ++k) {
      const auto p = static_cast<std::size_t>(graph_.particles[static_cast<std::size_t>(c * graph_.arity + k)]);
      for (Index i = incidence_.offsets[p]; i < incidence_.offsets[p + 1]; ++i) {
        const Index other = incidence_.constraints[static_cast<std::size_t>(i)];
        if (last_seen_[static_cast<std::size_t>(other)] == time_) continue;
        last_seen_[static_cast<std::size_t>(other)] = time_;
        see(other);
      }
    }
  }

 private:
  const ConstraintGraph& graph_;
  Incidence incidence_;
  std::vector<Index> last_seen_;  ///< the time of each
  Index time_ = 0;
};

/// Constraints by degree; of those of one degree, the last that came to it is first.
class Buckets {
 public:
  explicit Buckets(Index count)
      : next_(static_cast<std::size_t>(count), -1), previous_(static_cast<std::size_t>(count), -1) {}

  void put(Index c, Index degree) {
    if (first_.size() <= static_cast<std::size_t>(degree)) first_.resize(static_cast<std::size_t>(degree) + 1, -1);
    Index& first = first_[static_cast<std::size_t>(degree)];
    next_[static_cast<std::size_t>(c)] = first;
    previous_[static_cast<std::size_t>(c)] = -1;
    if (first >= 0) previous_[static_cast<std::size_t>(first)] = c;
    first = c;
  }

  void take(Index c, Index degree) {
    const Index next = next_[static_cast<std::size_t>(c)], previous = previous_[static_cast<std::size_t>(c)];
    (previous < 0 ? first_[static_cast<std::size_t>(degree)] : next_[static_cast<std::size_t>(previous)]) = next;
    if (next >= 0) previous_[static_cast<std::size_t>(next)] = previous;
  }

  /// -1 where there is none.
  Index first(Index degree) const { return first_[static_cast<std::size_t>(degree)]; }

 private:
  std::vector<Index> first_, next_, previous_;
};

/// Repeatedly takes away a constraint with the fewest remaining conflicts; the coloring order is the reverse.
std::vector<Index> smallest_last_order(Conflicts& conflicts) {
  const Index count = conflicts.constraint_count();
  std::vector<Index> degree(static_cast<std::size_t>(count), 0);
  Buckets buckets(count);
  for (Index c = 0; c < count; ++c) {
    Index& own = degree[static_cast<std::size_t>(c)];
    conflicts.for_each(c, [&](Index) { ++own; });
    buckets.put(c, own);
  }
  constexpr Index taken = -1;
  std::vector<Index> order;
  order.reserve(static_cast<std::size_t>(count));
  Index lowest = 0;
  while (static_cast<Index>(order.size()) < count) {
    while (buckets.first(lowest) < 0) ++lowest;
    const Index c = buckets.first(lowest);
    buckets.take(c, lowest);
    degree[static_cast<std::size_t>(c)] = taken;
    order.push_back(c);
    conflicts.for_each(c, [&](Index other) {
      Index& others = degree[static_cast<std::size_t>(other)];
      if (others == taken) return;
      buckets.take(other, others);
      buckets.put(other, --others);
      lowest = std::min(lowest, others);
    });
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

std::vector<Index> color_constraints(const ConstraintGraph& graph) {
  if (graph.particles.empty()) return {};
  Conflicts conflicts(graph);
  std::vector<Index> colors(static_cast<std::size_t>(graph.constraint_count()), -1);
  std::vector<Index> used_by;  // per color: the last constraint that found it taken
  for (Index c : smallest_last_order(conflicts)) {
    conflicts.for_each(c, [&](Index other) {
      const Index color = colors[static_cast<std::size_t>(other)];
      if (color >= 0) used_by[static_cast<std::size_t>(color)] = c;
    });
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
