#include <gracilis/dynamics/contact/field/field_contact_listing.hpp>

#include <gracilis/dynamics/contact/field/field_contact_edges.hpp>
#include <gracilis/dynamics/contact/field/field_contact_points.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gracilis {

namespace {

/// No point of an edge is nearer to its gap than this: distances fall by no more than what lies between a point and the
/// ends.
float least_clearance(float clearances, float length) { return (clearances - steepest * length) / 2; }

void list_edge(Index a, Index b, float sag, float least, const FieldPlacement& placement, const Particles& particles,
               NearField& near) {
  NearEdges& edges = near.edges;
  const Eigen::Vector3f middle = placement.to_obstacle((particles.position(a) + particles.position(b)) / 2);
  edges.a.push_back(a), edges.b.push_back(b);
  const auto gap = [&](Index p, Index other) {
    return sag + gap_of_end(particles.inverse_mass(p) > 0, near.clearance[static_cast<std::size_t>(p)],
                            near.gap[static_cast<std::size_t>(p)], near.gap[static_cast<std::size_t>(other)]);
  };
  edges.gap_a.push_back(gap(a, b)), edges.gap_b.push_back(gap(b, a));
  const auto untested = [&](Index p) {
    return untested_share(particles.inverse_mass(p) > 0, near.clearance[static_cast<std::size_t>(p)]);
  };
  edges.low.push_back(untested(a)), edges.high.push_back(1 - untested(b));
  edges.t.push_back(unknown_point);
  edges.seen_x.push_back(middle.x()), edges.seen_y.push_back(middle.y()), edges.seen_z.push_back(middle.z());
  edges.seen_above.push_back(least);
}

/// No point of a triangle is farther from its nearest corner than this share of its longest edge.
constexpr float farthest_of_corner = 0.58f;

/// An edge may come near where the sum of the clearances at its ends is at most this and so many times its length at
/// rest; that needs no position.
constexpr float low_sum = 2 * element_reach, low_per_length = 4 * steepest;

/// Whether any edge may; most surfaces are far away from most obstacles.
bool any_may_come_near(const DistanceSet& distances, const NearField& near) {
  if (near.clearance.empty() || distances.rest_length.empty()) return false;
  return 2 * *std::min_element(near.clearance.begin(), near.clearance.end()) <=
         low_sum + low_per_length * *std::max_element(distances.rest_length.begin(), distances.rest_length.end());
}

void clear(NearEdges& edges) {
  edges.a.clear(), edges.b.clear();
  for (AlignedVector<float>* each : {&edges.gap_a, &edges.gap_b, &edges.low, &edges.high, &edges.t, &edges.seen_x,
                                     &edges.seen_y, &edges.seen_z, &edges.seen_above})
    each->clear();
  edges.colors.clear();
}

void clear(NearFaces& faces) {
  faces.slots.clear(), faces.where.clear(), faces.gap.clear(), faces.seen.clear();
  faces.colors.clear();
}

}  // namespace

void clear_near(NearField& near) {
  near.particles.clear();
  clear(near.edges);
  clear(near.faces);
}

float listing_reach(const DistanceSet& distances, float reach) {
  const float longest =
      distances.rest_length.empty() ? 0 : *std::max_element(distances.rest_length.begin(), distances.rest_length.end());
  return std::max(reach, element_reach + low_per_length * longest);
}

void list_edges(const FieldContactSet& set, const DistanceSet& distances, const FieldPlacement& placement,
                const Particles& particles, NearField& near) {
  if (!any_may_come_near(distances, near)) return;
  std::vector<Index> slots;
  for (const ColorRange& color : distances.order.colors) {
    const Index begin = near.edges.count();
    slots.clear();
    gather_low_edges(distances, color, near.clearance, low_sum, low_per_length, slots);
    for (const Index slot : slots) {
      const auto at = static_cast<std::size_t>(slot);
      const Index a = distances.a[at], b = distances.b[at];
      const float clearances =
          near.clearance[static_cast<std::size_t>(a)] + near.clearance[static_cast<std::size_t>(b)];
      if (!(particles.inverse_mass(a) + particles.inverse_mass(b) > 0)) continue;
      const float least = least_clearance(clearances, (particles.position(b) - particles.position(a)).norm());
      if (least > element_reach) continue;
      list_edge(a, b, blended(set.captured.edge_sag, set.released.edge_sag, at, placement.release), least, placement,
                particles, near);
    }
    const Index idle = particles.count();
    while (near.edges.count() % group_width != 0)
      list_edge(idle, idle, 0, std::numeric_limits<float>::infinity(), placement, particles, near);
    near.edges.colors.push_back({begin, near.edges.count()});
  }
}

/// Whether a face is so far away, by the clearances of its corners, that list_faces leaves it out; not where it nearly
/// is. Wherever the obstacle is, edges are as long as they are, but for rounding.
static bool is_surely_away(const FaceSet& faces, Index slot, const Particles& particles, const NearField& near) {
  constexpr float roundings = 1.001f;
  float clearance = std::numeric_limits<float>::infinity(), longest2 = 0;
  std::array<Eigen::Vector3f, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const Index p = faces.particles[k][static_cast<std::size_t>(slot)];
    corners[k] = particles.position(p);
    clearance = std::min(clearance, near.clearance[static_cast<std::size_t>(p)]);
  }
  for (std::size_t k = 0; k < 3; ++k) longest2 = std::max(longest2, (corners[k] - corners[(k + 1) % 3]).squaredNorm());
  return clearance > roundings * (element_reach + farthest_of_corner * steepest * std::sqrt(longest2));
}

void list_faces(const FieldContactSet& set, const FaceSet& faces, const FieldPlacement& placement,
                const Particles& particles, NearField& near) {
  for (const ColorRange& color : faces.colors) {
    const Index first = near.faces.count();
    for (Index slot = color.begin; slot < color.end; ++slot) {
      if (is_surely_away(faces, slot, particles, near)) continue;
      std::array<ContactCorner, 3> corners;
      Eigen::Vector3f movable;
      float longest2 = 0, clearance = std::numeric_limits<float>::infinity(), untested = 0;
      float largest_gap = -std::numeric_limits<float>::infinity();
      for (std::size_t k = 0; k < 3; ++k) {
        const Index p = faces.particles[k][static_cast<std::size_t>(slot)];
        corners[k] = {placement.to_obstacle(particles.position(p)), near.gap[static_cast<std::size_t>(p)]};
        largest_gap = std::max(largest_gap, corners[k].gap);
        const float above = near.clearance[static_cast<std::size_t>(p)];
        const bool moves = particles.inverse_mass(p) > 0;
        clearance = std::min(clearance, above);
        untested = std::max(untested, untested_share(moves, above));
        movable[static_cast<Eigen::Index>(k)] = moves;
      }
      for (std::size_t k = 0; k < 3; ++k)
        longest2 = std::max(longest2, (corners[k].q - corners[(k + 1) % 3].q).squaredNorm());
      for (std::size_t k = 0; k < 3; ++k) {
        const Index p = faces.particles[k][static_cast<std::size_t>(slot)];
        corners[k].gap = gap_of_end(movable[static_cast<Eigen::Index>(k)] > 0,
                                    near.clearance[static_cast<std::size_t>(p)], corners[k].gap, largest_gap);
      }
      if (movable.isZero() || clearance > element_reach + farthest_of_corner * steepest * std::sqrt(longest2)) continue;
      near.faces.slots.push_back(slot);
      const Eigen::Vector3f where = deepest_tested(set.field.grid, corners, movable, untested);
      float gap =
          blended(set.captured.face_sag, set.released.face_sag, static_cast<std::size_t>(slot), placement.release);
      for (std::size_t k = 0; k < 3; ++k) gap += where[static_cast<Index>(k)] * corners[k].gap;
      near.faces.where.push_back(where);
      near.faces.gap.push_back(gap);
      near.faces.seen.emplace_back();
    }
    near.faces.colors.push_back({first, near.faces.count()});
  }
}

}  // namespace gracilis
