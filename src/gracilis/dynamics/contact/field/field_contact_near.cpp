#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/coloring.hpp>
#include <gracilis/dynamics/contact/field/field_contact.hpp>
#include <gracilis/dynamics/contact/field/field_contact_away.hpp>
#include <gracilis/dynamics/contact/field/field_contact_edges.hpp>
#include <gracilis/dynamics/contact/field/field_contact_guard.hpp>
#include <gracilis/dynamics/contact/field/field_contact_points.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

namespace {

constexpr Index chunk = 512;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Cosine of the turn by which the published test knows a vertex that passed through a bone.
const float turned_cosine = static_cast<float>(std::cos(radians(135)));

bool passed(const FieldContactSet& set, const Eigen::Vector3f& before, const Eigen::Vector3f& gradient_now) {
  const Eigen::Vector3f gradient = sample(set.field.grid, before).gradient;
  return gradient.dot(gradient_now) < turned_cosine * gradient.norm() * gradient_now.norm();
}

/// Whether the way from where it last was is so long that its end alone does not tell the side.
bool is_fast(const FieldContactSet& set, const Sighting& last, const Eigen::Vector3f& q, float gap) {
  const float moved = (q - last.place).norm(), safe = safe_step(*set.field.field);
  return moved > safe && moved > 0.9f * (last.distance - gap) - 2 * safe;
}

float blended(const std::vector<float>& captured, const std::vector<float>& released, std::size_t i, float release) {
  return captured[i] + release * (released[i] - captured[i]);
}

/// Clearance of every particle, those that are near, and where they are. A particle is asked again only once it may
/// have used up what it was away when last seen.
void see_particles(const FieldContactSet& set, const FieldPlacement& placement, float reach, Particles& particles,
                   NearField& near, std::vector<char>& is_near) {
  const auto count = static_cast<std::size_t>(particles.count());
  const bool known = near.last.size() == count;
  near.last.resize(count);
  near.gap.resize(count + 1, 0);
  near.clearance.resize(count + 1, infinity);
  const auto cell = static_cast<float>(set.field.field->cell_size.maxCoeff());
  parallel_for(particles.count(), chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const auto p = static_cast<std::size_t>(i);
      const float gap = blended(set.captured.particle, set.released.particle, p, placement.release);
      const bool bound = !set.ceiling.empty() && std::isfinite(set.ceiling[p]);
      near.gap[p] = gap;
      Eigen::Vector3f q = placement.to_obstacle(particles.position(i));
      if (known && !bound) {
        const float left = near.last[p].distance - steepest * (q - near.last[p].place).norm() - cell - gap;
        near.clearance[p] = left;
        if (left > reach) continue;
      }
      const bool movable = particles.inverse_mass(i) > 0;
      if (known && movable) {
        const Eigen::Vector3f kept = guarded(set, near.last[p], q, gap);
        if (kept != q) particles.position(i) = placement.from_obstacle(kept);
        q = kept;
      }
      const float distance = sample_bounded(set.field, q).distance;
      near.last[p] = {q, distance};
      near.clearance[p] = distance - gap;
      is_near[p] = movable && (bound || distance < gap + reach);
    }
  });
}

/// No point of an edge is nearer to its gap than this: distances fall by no more than what lies between a point and the
/// ends.
float least_clearance(float clearances, float length) { return (clearances - steepest * length) / 2; }

}  // namespace

Eigen::Vector3f guarded(const FieldContactSet& set, const Sighting& last, const Eigen::Vector3f& q, float gap) {
  if (set.guard == MotionGuard::kept_path && is_fast(set, last, q, gap))
    return kept_path(set.field, last.place, q, std::min(gap, last.distance));
  if (set.guard == MotionGuard::turned_direction && passed(set, last.place, sample(set.field.grid, q).gradient))
    return last.place;
  return q;
}

FaceSet build_face_set(const Eigen::Matrix3Xi& faces, Index particle_count) {
  ConstraintGraph graph{3, particle_count, {faces.data(), faces.data() + faces.size()}};
  const std::vector<Index> colors = color_constraints(graph);
  FaceSet set;
  const Index color_count = colors.empty() ? 0 : *std::max_element(colors.begin(), colors.end()) + 1;
  for (Index color = 0; color < color_count; ++color) {
    const Index begin = set.count();
    for (Index f = 0; f < faces.cols(); ++f)
      for (int k = 0; k < 3 && colors[static_cast<std::size_t>(f)] == color; ++k)
        set.particles[static_cast<std::size_t>(k)].push_back(faces(k, f));
    set.colors.push_back({begin, set.count()});
  }
  return set;
}

void remember_sides(const FieldContactSet& set, const FieldPlacement& placement, const Particles& particles,
                    NearField& near) {
  const auto count = static_cast<std::size_t>(particles.count());
  const bool known = near.last.size() == count;
  near.last.resize(count);
  const auto cell = static_cast<float>(set.field.field->cell_size.maxCoeff());
  parallel_for(particles.count(), chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      Sighting& last = near.last[static_cast<std::size_t>(i)];
      const Eigen::Vector3f q = placement.to_obstacle(particles.position(i));
      if (!known || may_reach(last, q, far_away + cell)) last = {q, sample_bounded(set.field, q).distance};
    }
  });
}

static void list_edge(Index a, Index b, float sag, float least, const FieldPlacement& placement,
                      const Particles& particles, NearField& near) {
  NearEdges& edges = near.edges;
  const Eigen::Vector3f middle = placement.to_obstacle((particles.position(a) + particles.position(b)) / 2);
  edges.a.push_back(a), edges.b.push_back(b);
  edges.gap_a.push_back(near.gap[static_cast<std::size_t>(a)] + sag);
  edges.gap_b.push_back(near.gap[static_cast<std::size_t>(b)] + sag);
  edges.t.push_back(unknown_point);
  edges.seen_x.push_back(middle.x()), edges.seen_y.push_back(middle.y()), edges.seen_z.push_back(middle.z());
  edges.seen_above.push_back(least);
}

static void clear(NearEdges& edges) {
  edges.a.clear(), edges.b.clear();
  for (AlignedVector<float>* each :
       {&edges.gap_a, &edges.gap_b, &edges.t, &edges.seen_x, &edges.seen_y, &edges.seen_z, &edges.seen_above})
    each->clear();
  edges.colors.clear();
}

static void clear(NearFaces& faces) {
  faces.slots.clear(), faces.where.clear(), faces.gap.clear(), faces.seen.clear();
  faces.colors.clear();
}

/// An edge may come near where the sum of the clearances at its ends is at most this and so many times its length at
/// rest; that needs no position.
static constexpr float low_sum = 2 * element_reach, low_per_length = 4 * steepest;

/// Whether any edge may; most surfaces are far away from most obstacles.
static bool any_may_come_near(const DistanceSet& distances, const NearField& near) {
  if (near.clearance.empty() || distances.rest_length.empty()) return false;
  return 2 * *std::min_element(near.clearance.begin(), near.clearance.end()) <=
         low_sum + low_per_length * *std::max_element(distances.rest_length.begin(), distances.rest_length.end());
}

static void list_edges(const FieldContactSet& set, const DistanceSet& distances, const FieldPlacement& placement,
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
    while (near.edges.count() % group_width != 0) list_edge(idle, idle, 0, infinity, placement, particles, near);
    near.edges.colors.push_back({begin, near.edges.count()});
  }
}

/// The part of a face that is tested, as barycentric coordinates of its corners, one per column. `movable` has ones and
/// zeros, and sums to more than 0.
static Eigen::Matrix3f tested_part(const Eigen::Vector3f& movable) {
  Eigen::Matrix3f part = Eigen::Matrix3f::Identity();
  for (int k = 0; k < 3; ++k)
    if (movable[k] == 0) part.col(k) += untested_share * (movable / movable.sum() - part.col(k));
  return part;
}

/// The deepest point of the part of a face that is tested, barycentric.
static Eigen::Vector3f deepest_tested(const FieldGrid& grid, const std::array<ContactCorner, 3>& corners,
                                      const Eigen::Vector3f& movable) {
  const Eigen::Vector3f deepest = deepest_on_face(grid, corners);
  if (deepest.dot(movable) >= untested_share) return deepest;
  const Eigen::Matrix3f part = tested_part(movable);
  std::array<ContactCorner, 3> tested;
  for (int k = 0; k < 3; ++k) {
    ContactCorner& corner = tested[static_cast<std::size_t>(k)] = {Eigen::Vector3f::Zero(), 0};
    for (int c = 0; c < 3; ++c) {
      corner.q += part(c, k) * corners[static_cast<std::size_t>(c)].q;
      corner.gap += part(c, k) * corners[static_cast<std::size_t>(c)].gap;
    }
  }
  return part * deepest_on_face(grid, tested);
}

static void list_faces(const FieldContactSet& set, const FaceSet& faces, const FieldPlacement& placement,
                       const Particles& particles, NearField& near) {
  for (const ColorRange& color : faces.colors) {
    const Index first = near.faces.count();
    for (Index slot = color.begin; slot < color.end; ++slot) {
      std::array<ContactCorner, 3> corners;
      Eigen::Vector3f movable;
      float longest2 = 0, clearance = infinity;
      for (std::size_t k = 0; k < 3; ++k) {
        const Index p = faces.particles[k][static_cast<std::size_t>(slot)];
        corners[k] = {placement.to_obstacle(particles.position(p)), near.gap[static_cast<std::size_t>(p)]};
        clearance = std::min(clearance, near.clearance[static_cast<std::size_t>(p)]);
        movable[static_cast<Eigen::Index>(k)] = particles.inverse_mass(p) > 0;
      }
      for (std::size_t k = 0; k < 3; ++k)
        longest2 = std::max(longest2, (corners[k].q - corners[(k + 1) % 3].q).squaredNorm());
      // No point of a triangle is farther from its nearest corner than this share of its longest edge.
      if (movable.isZero() || clearance > element_reach + 0.58f * steepest * std::sqrt(longest2)) continue;
      near.faces.slots.push_back(slot);
      const Eigen::Vector3f where = deepest_tested(set.field.grid, corners, movable);
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

void find_edge_points(const FieldContactSet& set, const FieldPlacement& placement, const Particles& particles,
                      NearField& near) {
  find_deepest_points(set.field.grid, placement, particles, near.edges);
}

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

void find_near(const FieldContactSet& set, const DistanceSet& distances, const FaceSet& faces,
               const FieldPlacement& placement, float reach, Particles& particles, NearField& near) {
  clear_near(near);
  std::vector<char> is_near(static_cast<std::size_t>(particles.count()), 0);
  see_particles(set, placement, reach, particles, near, is_near);
  near.away = seen_away(set, placement, near);
  for (Index i = 0; i < particles.count(); ++i)
    if (is_near[static_cast<std::size_t>(i)]) near.particles.push_back(i);
  if (!set.captured.edge_sag.empty()) list_edges(set, distances, placement, particles, near);
  find_edge_points(set, placement, particles, near);
  if (!set.captured.face_sag.empty()) list_faces(set, faces, placement, particles, near);
}

}  // namespace gracilis
