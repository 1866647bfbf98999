#include <gracilis/simulate/belly_place.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/core/sort_unique.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/shortest_paths.hpp>
#include <gracilis/geometry/topology.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

namespace {

constexpr std::size_t most_vertices = 160;
constexpr Real reach = 0.010;      ///< m
constexpr Real least_share = 0.1;  ///< of the belly's surface
constexpr Real far_away = 1e3;     ///< m
constexpr Real rounding_factor = 1 + 1e-9;

std::vector<Index> attached_by(const Muscle& muscle, AttachmentEnd end) {
  std::vector<Index> vertices;
  for (const Attachment& attachment : muscle.attachments)
    if (attachment.end == end) vertices.insert(vertices.end(), attachment.vertices.begin(), attachment.vertices.end());
  return vertices;
}

/// Evenly spread over the numbers of the vertices of the middle third.
std::vector<Index> belly_vertices(const Muscle& muscle) {
  const Eigen::VectorXd share = share_of_way(muscle);
  std::vector<Index> middle, chosen;
  for (Index v = 0; v < share.size(); ++v)
    if (share[v] >= 1.0 / 3 && share[v] <= 2.0 / 3) middle.push_back(v);
  const std::size_t count = std::min(middle.size(), most_vertices);
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(middle[(2 * i + 1) * middle.size() / (2 * count)]);
  return chosen;
}

}  // namespace

Eigen::VectorXd share_of_way(const Muscle& muscle) {
  const std::vector<Index> origin = attached_by(muscle, AttachmentEnd::origin),
                           insertion = attached_by(muscle, AttachmentEnd::insertion);
  const Index count = muscle.surface.vertex_count();
  if (origin.empty() || insertion.empty()) return Eigen::VectorXd::Constant(count, std::nan(""));
  const EdgeGraph graph = length_graph(muscle.surface.vertices, build_topology(muscle.surface.faces, count));
  const Eigen::VectorXd from = edge_distances(graph, origin), to = edge_distances(graph, insertion);
  return from.array() / (from + to).array();
}

BellyPlace::BellyPlace(const Scene& scene, const std::vector<SignedDistance>& bones, const TautWays& ways)
    : scene_(scene), bones_(bones), ways_(ways), contacts_(scene.muscles.size()), grounds_(scene.muscles.size()) {
  Frame frame;
  frame.pose = capture_pose(scene.bodies.size());
  for (const Muscle& muscle : scene.muscles) {
    around_.push_back(faces_around(muscle.surface.faces, muscle.surface.vertex_count()));
    frame.muscles.push_back({muscle.surface.vertices});
  }
  const Surroundings rest = surroundings(frame, std::vector<char>(scene.muscles.size(), 1));
  parallel_for_each(contacts_.size(), [&](std::size_t m) { contacts_[m] = contacts_of(m, rest); });
  asked_.assign(scene.muscles.size(), 0);
  for (std::size_t m = 0; m < contacts_.size(); ++m) {
    for (const Contact& contact : contacts_[m]) {
      grounds_[m].insert(grounds_[m].end(), contact.bones.begin(), contact.bones.end());
      for (const std::size_t other : contact.muscles) asked_[other] = 1;
    }
    sort_unique(grounds_[m]);
  }
  // As it will be asked for, so that nothing has come off in the capture pose.
  parallel_for_each(contacts_.size(), [&](std::size_t m) {
    for (Contact& contact : contacts_[m]) {
      const Vec3 p = frame.muscles[m].points.col(contact.vertex);
      contact.rest_gap = gap(m, contact, rest, p);
      contact.carrier = nearest_bone(p);
      contact.place = place_beside(ways_.of(m), p);
    }
  });
}

BellyPlace::Surroundings BellyPlace::surroundings(const Frame& frame, const std::vector<char>& asked) const {
  Surroundings around;
  for (const Bone& bone : scene_.bones)
    around.to_local.push_back(frame.pose.bodies[static_cast<std::size_t>(bone.body)].inverse());
  around.shapes.resize(scene_.muscles.size());
  parallel_for_each(around.shapes.size(), [&](std::size_t m) {
    if (asked[m]) around.shapes[m].emplace(frame.muscles[m].points, scene_.muscles[m].surface.faces, around_[m]);
  });
  return around;
}

/// 0 inside; infinite beyond `reach`.
Real BellyPlace::bone_gap(std::size_t bone, const Surroundings& around, const Vec3& p, Real bone_reach) const {
  return std::max(bones_[bone].query(around.to_local[bone] * p, bone_reach).distance, Real{0});
}

/// In the capture pose.
std::optional<std::size_t> BellyPlace::nearest_bone(const Vec3& p) const {
  std::optional<std::size_t> bone;
  Real nearest = std::numeric_limits<Real>::infinity();
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    const Real distance = bones_[b].query(p, nearest).distance;
    if (distance < nearest) nearest = std::max(distance, Real{0}), bone = b;
  }
  return bone;
}

std::vector<BellyPlace::Contact> BellyPlace::contacts_of(std::size_t muscle, const Surroundings& rest) const {
  struct Candidate {
    Contact contact;
    std::vector<Real> bone_gaps, muscle_gaps;
  };
  const TriangleMesh& surface = scene_.muscles[muscle].surface;
  const Eigen::VectorXd areas = vertex_areas(surface.vertices, surface.faces);
  std::vector<Candidate> candidates;
  Real area = 0;
  for (const Index v : belly_vertices(scene_.muscles[muscle])) {
    Candidate& candidate = candidates.emplace_back();
    candidate.contact = {v, areas[v], far_away, {}, {}, {}, {}};
    area += areas[v];
    const Vec3 p = surface.vertices.col(v);
    // What is beyond both the reach and the nearest so far is not asked for: it counts as far away.
    Real& nearest = candidate.contact.rest_gap;
    for (std::size_t b = 0; b < bones_.size(); ++b) {
      candidate.bone_gaps.push_back(std::min(bone_gap(b, rest, p, std::max(nearest, reach)), far_away));
      nearest = std::min(nearest, candidate.bone_gaps.back());
    }
    for (std::size_t m = 0; m < rest.shapes.size(); ++m) {
      const bool is_far = m == muscle || rest.shapes[m]->gap_to_box(p) > std::max(nearest, reach);
      candidate.muscle_gaps.push_back(is_far ? far_away : rest.shapes[m]->gap(p));
      nearest = std::min(nearest, candidate.muscle_gaps.back());
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.contact.rest_gap < b.contact.rest_gap; });
  std::vector<Contact> contacts;
  Real taken = 0;
  for (Candidate& candidate : candidates) {
    const Real nearest = candidate.contact.rest_gap;
    if (nearest >= far_away || (nearest > reach && taken > least_share * area)) break;
    const Real lies = std::max(reach, nearest * rounding_factor);
    for (std::size_t b = 0; b < candidate.bone_gaps.size(); ++b)
      if (candidate.bone_gaps[b] <= lies) candidate.contact.bones.push_back(b);
    for (std::size_t m = 0; m < candidate.muscle_gaps.size(); ++m)
      if (candidate.muscle_gaps[m] <= lies) candidate.contact.muscles.push_back(m);
    taken += candidate.contact.area;
    contacts.push_back(std::move(candidate.contact));
  }
  return contacts;
}

Real BellyPlace::gap(std::size_t muscle, const Contact& contact, const Surroundings& around, const Vec3& p) const {
  Real nearest = std::numeric_limits<Real>::infinity();
  for (const std::size_t other : contact.muscles)
    if (around.shapes[other]->gap_to_box(p) < nearest) nearest = std::min(nearest, around.shapes[other]->gap(p));
  for (const std::size_t bone : grounds_[muscle]) nearest = std::min(nearest, bone_gap(bone, around, p, nearest));
  return nearest;
}

/// How far a vertex is from where its carrier has taken it.
Real BellyPlace::moved(std::size_t muscle, const Contact& contact, const Surroundings& around, const Vec3& p) const {
  if (!contact.carrier) return std::numeric_limits<Real>::infinity();
  return (around.to_local[*contact.carrier] * p - scene_.muscles[muscle].surface.vertices.col(contact.vertex)).norm();
}

/// How far a vertex is from where its taut way has taken it, beyond what thickening explains.
Real BellyPlace::off_way(std::size_t muscle, const Contact& contact, const Vec3& p, Real thickening) const {
  if (!contact.place) return std::numeric_limits<Real>::infinity();
  return distance_from_place(*contact.place, ways_.of(muscle), p) - (thickening - 1) * contact.place->offset.norm();
}

std::vector<Real> BellyPlace::off_place(const Frame& frame, const std::vector<Real>& length_ratios) const {
  const Surroundings around = surroundings(frame, asked_);
  std::vector<Real> off(contacts_.size(), 0);
  parallel_for_each(contacts_.size(), [&](std::size_t m) {
    const Real thickening = std::max(std::sqrt(1 / length_ratios[m]), Real{1});
    Real sum = 0, area = 0;
    for (const Contact& contact : contacts_[m]) {
      const Vec3 p = frame.muscles[m].points.col(contact.vertex);
      const Real come_off = gap(m, contact, around, p) - thickening * contact.rest_gap;
      area += contact.area;
      if (!(come_off > 0)) continue;
      const Real least = std::min({come_off, moved(m, contact, around, p), off_way(m, contact, p, thickening)});
      sum += contact.area * std::max(least, Real{0});
    }
    if (area > 0) off[m] = sum / area;
  });
  return off;
}

}  // namespace gracilis
