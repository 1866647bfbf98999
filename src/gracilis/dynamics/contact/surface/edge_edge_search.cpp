#include <gracilis/dynamics/contact/surface/edge_edge_search.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/core/sort_unique.hpp>
#include <gracilis/dynamics/contact/mesh/edge_crossings.hpp>
#include <gracilis/dynamics/contact/surface/overlap_release.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gracilis {

namespace {

constexpr Index edges_per_task = 256;
/// Edges that cross as closely are listed (m). There are three times as many as particles; between two looks they
/// hardly come nearer by more.
constexpr float edges_listed_within = 0.0008f;

/// The edges of a face and of the faces behind its sides.
void gather_edges(const ContactSurface& surface, Index face, std::vector<Index>& edges) {
  for (int corner = 0; corner < 3; ++corner) {
    const Index side = surface.sides(corner, face), behind = surface.across(corner, face);
    edges.push_back(side);
    if (behind < 0) continue;
    for (const Index other : surface.sides.col(behind))
      if (other != side) edges.push_back(other);
  }
}

/// Sum of the unit normals of an edge's faces.
Eigen::Vector3f edge_normal(const ContactSurface& surface, Index edge, const Particles& particles) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const Index face : surface.edges[static_cast<std::size_t>(edge)].faces) {
    if (face < 0) continue;
    sum += face_area(surface, face, particles).normalized();
  }
  return sum;
}

bool any_overlaps(const std::vector<char>& overlaps, const std::array<Index, 2>& ends) {
  return overlaps_at_rest(overlaps, ends[0]) || overlaps_at_rest(overlaps, ends[1]);
}

float largest_gap(const std::vector<float>& gaps, const std::array<Index, 2>& ends) {
  return std::max(gaps[static_cast<std::size_t>(ends[0])], gaps[static_cast<std::size_t>(ends[1])]);
}

/// What two edges at this distance from each other may be asked to keep in this step, m; nothing where they overlap at
/// rest and did not cross before the step. `outward` is as edge_gap wants it.
std::optional<float> most_gap(const SurfacePair& pair, float distance, const std::array<Index, 2>& first,
                              const std::array<Index, 2>& second, const Particles& first_before,
                              const Particles& second_before, const Eigen::Vector3f& outward) {
  const bool overlapped = any_overlaps(pair.first_overlaps, first) || any_overlaps(pair.second_overlaps, second);
  if (distance >= 0 && !overlapped) return std::numeric_limits<float>::infinity();
  const EdgeGap before =
      edge_gap(first_before.position(first[0]) + pair.shift, first_before.position(first[1]) + pair.shift,
               second_before.position(second[0]), second_before.position(second[1]), outward);
  if (!before.crossing) return overlapped ? std::nullopt : std::optional(std::numeric_limits<float>::infinity());
  const float gap = std::max(largest_gap(pair.first_gap, first), largest_gap(pair.second_gap, second));
  return released(before.distance, gap, overlapped ? pair.release : asked_at_once);
}

/// Whether a particle is so near that an edge of this length from it may cross another closely: one that does has an
/// end within half of its length and that.
bool is_near_enough(const VertexFaceCandidate& candidate, float length2) {
  const float beyond = candidate.distance - edges_listed_within;
  return beyond < 0 || 4 * beyond * beyond < length2;
}

/// Looks up what a particle is near.
class CandidateTable {
 public:
  CandidateTable(const std::vector<VertexFaceCandidate>& near, Index particle_count)
      : near_(near), at_(static_cast<std::size_t>(particle_count), -1) {
    for (std::size_t i = 0; i < near.size(); ++i)
      at_[static_cast<std::size_t>(near[i].particle)] = static_cast<Index>(i);
  }

  /// What this end of an edge is near if the edge may cross another closely by it, else null.
  const VertexFaceCandidate* near_enough(Index end, float length2) const {
    const Index at = at_[static_cast<std::size_t>(end)];
    if (at < 0) return nullptr;
    const VertexFaceCandidate& candidate = near_[static_cast<std::size_t>(at)];
    return is_near_enough(candidate, length2) ? &candidate : nullptr;
  }

 private:
  const std::vector<VertexFaceCandidate>& near_;
  std::vector<Index> at_;
};

/// The edges that may cross others closely by what their ends are near, each once.
std::vector<Index> edges_around(const std::vector<VertexFaceCandidate>& near, const CandidateTable& table,
                                const ContactSurface& surface, const Particles& particles) {
  return collect_in_order<Index>(
      static_cast<Index>(near.size()), edges_per_task, [&](Index begin, Index end, std::vector<Index>& part) {
        for (Index i = begin; i < end; ++i) {
          const VertexFaceCandidate& candidate = near[static_cast<std::size_t>(i)];
          for (const Index edge : surface.edges_at(candidate.particle)) {
            const auto& ends = surface.edges[static_cast<std::size_t>(edge)].ends;
            const float length2 = (particles.position(ends[1]) - particles.position(ends[0])).squaredNorm();
            if (!is_near_enough(candidate, length2)) continue;
            // By its first end unless that is too far away.
            if (ends[0] == candidate.particle || !table.near_enough(ends[0], length2)) part.push_back(edge);
          }
        }
      });
}

}  // namespace

void find_edges(const ContactWorld& world, const SurfacePair& pair, const std::vector<const Particles*>& particles,
                const std::vector<Particles>& before, const std::vector<VertexFaceCandidate>& near_second,
                const SelfRule* self, std::vector<EdgeEdgeCandidate>& found) {
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  const ContactSurface &first = world.surfaces[a], &second = world.surfaces[b];
  found.clear();
  if (near_second.empty()) return;
  const CandidateTable table(near_second, particles[a]->count());
  const std::vector<Index> edges = edges_around(near_second, table, first, *particles[a]);
  const auto count = static_cast<Index>(edges.size());
  found = collect_in_order<
      EdgeEdgeCandidate>(count, edges_per_task, [&](Index begin, Index end, std::vector<EdgeEdgeCandidate>& part) {
    std::vector<Index> near_edges;
    for (Index i = begin; i < end; ++i) {
      const Index e = edges[static_cast<std::size_t>(i)];
      const auto& ends = first.edges[static_cast<std::size_t>(e)].ends;
      const Segment edge = {particles[a]->position(ends[0]) + pair.shift, particles[a]->position(ends[1]) + pair.shift};
      const auto segment_of = [&](Index other) -> Segment {
        const auto& its_ends = second.edges[static_cast<std::size_t>(other)].ends;
        return {particles[b]->position(its_ends[0]), particles[b]->position(its_ends[1])};
      };
      near_edges.clear();
      Index gathered = -1;
      for (const Index particle : ends) {
        const VertexFaceCandidate* near = table.near_enough(particle, edge.length2());
        if (!near || near->face == gathered) continue;
        if (self && self->side(particle, near->face) != near->side) continue;
        gather_edges(second, near->face, near_edges);
        gathered = near->face;
      }
      keep_crossing(edge, edges_listed_within, second, *particles[b], near_edges);
      if (near_edges.empty()) continue;
      sort_unique(near_edges);
      const Eigen::Vector3f own_normal = edge_normal(first, e, *particles[a]);
      for (const Index across : near_edges) {
        const auto& other = second.edges[static_cast<std::size_t>(across)].ends;
        const float side = self ? self->side(ends, other) : 1.0f;
        if (side == 0) continue;
        const Eigen::Vector3f outward = side * (edge_normal(second, across, *particles[b]) - own_normal);
        const Segment its = segment_of(across);
        const EdgeGap gap = edge_gap(edge.from, edge.to, its.from, its.to, outward);
        if (!gap.crossing || !(std::abs(gap.distance) < edges_listed_within)) continue;
        EdgeEdgeCandidate candidate{e, across, side,
                                    self ? self->most_gap(ends, other) : std::numeric_limits<float>::infinity()};
        const std::optional<float> most = most_gap(pair, gap.distance, ends, other, before[a], before[b], outward);
        if (!most) continue;
        candidate.most_gap = std::min(
            {candidate.most_gap, *most, largest_gap(pair.first_gap, ends), largest_gap(pair.second_gap, other)});
        part.push_back(candidate);
      }
    }
  });
}

}  // namespace gracilis
