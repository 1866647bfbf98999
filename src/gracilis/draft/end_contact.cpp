#include <gracilis/draft/end_contact.hpp>

#include <gracilis/anatomy/attachments/attachments.hpp>
#include <gracilis/core/sort_unique.hpp>
#include <gracilis/geometry/measures.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gracilis {
namespace {

/// Surfaces of muscles are drawn on bones or some millimetres away from them, as far as a tendon's cross section
/// reaches.
constexpr std::array<Real, 8> reaches = {0.003, 0.004, 0.005, 0.006, 0.008, 0.01, 0.012, 0.015};
constexpr Real least_area_share = 0.005;  // of the muscle's surface
constexpr Real crumb_share = 0.2;         // of the largest piece
constexpr Real end_share = 0.06;          // of a muscle's length is an end, where nothing else tells

std::vector<Index> within(const Eigen::VectorXd& distances, Real reach) {
  std::vector<Index> vertices;
  for (Index v = 0; v < distances.size(); ++v)
    if (distances[v] <= reach) vertices.push_back(v);
  return vertices;
}

}  // namespace

MuscleEnds::MuscleEnds(const TriangleMesh& surface, Real size)
    : surface_(surface),
      size_(size),
      topology_(build_topology(surface.faces, surface.vertex_count())),
      graph_(length_graph(surface.vertices, topology_)),
      areas_(vertex_areas(surface.vertices, surface.faces)) {}

bool MuscleEnds::is_enough(const std::vector<Index>& vertices) const {
  Real area = 0;
  for (const Index v : vertices) area += areas_[v];
  return static_cast<Index>(vertices.size()) >= handful && area >= least_area_share * areas_.sum();
}

std::vector<Index> MuscleEnds::without_crumbs(const std::vector<Index>& vertices) const {
  std::vector<int> piece(static_cast<std::size_t>(surface_.vertex_count()), -2);  // -2: not asked for
  for (const Index v : vertices) piece[static_cast<std::size_t>(v)] = -1;
  std::vector<Real> areas;
  for (const Index first : vertices) {
    if (piece[static_cast<std::size_t>(first)] != -1) continue;
    std::vector<Index> reached = {first};
    const int number = static_cast<int>(areas.size());
    piece[static_cast<std::size_t>(first)] = number;
    Real area = 0;
    for (std::size_t i = 0; i < reached.size(); ++i) {
      area += areas_[reached[i]];
      const auto star = static_cast<std::size_t>(reached[i]);
      for (Index k = topology_.stars.offsets[star]; k < topology_.stars.offsets[star + 1]; ++k) {
        const Index next = topology_.stars.neighbors[static_cast<std::size_t>(k)];
        if (piece[static_cast<std::size_t>(next)] != -1) continue;
        piece[static_cast<std::size_t>(next)] = number;
        reached.push_back(next);
      }
    }
    areas.push_back(area);
  }
  const Real largest = areas.empty() ? 0 : *std::max_element(areas.begin(), areas.end());
  std::vector<Index> kept;
  for (const Index v : vertices)
    if (areas[static_cast<std::size_t>(piece[static_cast<std::size_t>(v)])] >= crumb_share * largest) kept.push_back(v);
  return kept;
}

HeldVertices MuscleEnds::touching(const BoneParts& bones, const std::vector<Zone>& zones) const {
  const Index count = surface_.vertex_count();
  Eigen::VectorXd distances = Eigen::VectorXd::Constant(count, std::numeric_limits<Real>::infinity());
  std::vector<std::size_t> nearest(static_cast<std::size_t>(count), 0);
  for (const Zone& zone : zones)
    for (Index v = 0; v < count; ++v) {
      const Real distance = bones.distance(zone, surface_.vertices.col(v), reaches.back());
      if (distance < distances[v]) distances[v] = distance, nearest[static_cast<std::size_t>(v)] = zone.bone;
    }
  for (const Real reach : reaches) {
    HeldVertices held{without_crumbs(within(distances, reach)), {}, reach};
    if (!is_enough(held.vertices)) continue;
    for (const Index v : held.vertices) held.bones.push_back(nearest[static_cast<std::size_t>(v)]);
    sort_unique(held.bones);
    return held;
  }
  return {};
}

HeldVertices MuscleEnds::nearest(const BoneParts& bones, const std::vector<Zone>& zones) const {
  const Index count = surface_.vertex_count();
  Eigen::VectorXd distances = Eigen::VectorXd::Constant(count, std::numeric_limits<Real>::infinity());
  std::size_t of_bone = 0;
  Real least = std::numeric_limits<Real>::infinity();
  // In the zones where they can be reached, else anywhere on their bones.
  for (const bool anywhere : {false, true}) {
    if (std::isfinite(least)) break;
    for (const Zone& zone : zones) {
      const Zone where = anywhere ? Zone{zone.bone, {bones.bone(zone.bone).name}} : zone;
      for (Index v = 0; v < count; ++v) {
        const Real distance = bones.distance(where, surface_.vertices.col(v), std::numeric_limits<Real>::infinity());
        distances[v] = std::min(distances[v], distance);
        if (distance < least) least = distance, of_bone = zone.bone;
      }
    }
  }
  if (!std::isfinite(least)) return {};
  for (Real more = 0.003; more < 0.1; more *= 1.4) {
    HeldVertices held{within(distances, least + more * size_), {of_bone}, least};
    if (is_enough(held.vertices)) return held;
  }
  return {};
}

HeldVertices MuscleEnds::end_about(const Eigen::VectorXd& ways) const {
  const Real length = ways.maxCoeff();
  for (Real share = end_share; share < 0.5; share *= 1.4) {
    HeldVertices held;
    for (Index v = 0; v < ways.size(); ++v)
      if (ways[v] >= (1 - share) * length) held.vertices.push_back(v);
    held.vertices = without_crumbs(held.vertices);
    if (is_enough(held.vertices)) return held;
  }
  return {};
}

HeldVertices MuscleEnds::farthest(const std::vector<Index>& from) const {
  return end_about(edge_distances(graph_, from));
}

Eigen::VectorXd MuscleEnds::share_between_ends() const {
  const std::vector<HeldVertices> tips = both_ends();
  const Eigen::VectorXd from = edge_distances(graph_, tips[0].vertices), to = edge_distances(graph_, tips[1].vertices);
  return from.array() / (from + to).array().max(1e-9);
}

std::vector<HeldVertices> MuscleEnds::both_ends() const {
  Eigen::Index first = 0, second = 0;
  edge_distances(graph_, {0}).maxCoeff(&first);
  const Eigen::VectorXd from_first = edge_distances(graph_, {static_cast<Index>(first)});
  from_first.maxCoeff(&second);
  return {end_about(edge_distances(graph_, {static_cast<Index>(second)})), end_about(from_first)};
}

}  // namespace gracilis
