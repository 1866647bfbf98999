#include <gracilis/methods/xpbd/bone_gaps.hpp>

#include <algorithm>
#include <limits>

namespace gracilis::xpbd {

namespace {

/// Where an edge's or face's sag is looked for: this many parts of each side.
constexpr int sag_parts = 8;

/// Overlaps that stay give back this share of a cell once the bone has moved: so much can the grid's error differ from
/// place to place.
constexpr float given_back_by_kept = 0.1f;

std::vector<float> rest_distances(const PreparedMuscle& prepared, const DistanceField& field) {
  std::vector<float> distances;
  for (Index p = 0; p < prepared.rest.cols(); ++p)
    distances.push_back(sample(field, Eigen::Vector3f(prepared.rest.col(p).cast<float>())).distance);
  return distances;
}

/// Free particles in an overlap that reaches an attached particle. Where a muscle grows out of a bone, the data overlap
/// for a reason, and what is fixed could not follow anyway.
std::vector<char> grown_in(const PreparedMuscle& prepared, const MeshTopology& topology,
                           const std::vector<float>& distances) {
  std::vector<char> grown(distances.size(), 0);
  std::vector<Index> front;
  for (Index p = 0; p < prepared.rest.cols(); ++p)
    if (prepared.fixed_body[static_cast<std::size_t>(p)] >= 0) front.push_back(p);
  while (!front.empty()) {
    const Index p = front.back();
    front.pop_back();
    for (Index i = topology.stars.offsets[static_cast<std::size_t>(p)];
         i < topology.stars.offsets[static_cast<std::size_t>(p) + 1]; ++i) {
      const auto next = static_cast<std::size_t>(topology.stars.neighbors[static_cast<std::size_t>(i)]);
      if (grown[next] || prepared.fixed_body[next] >= 0 || distances[next] >= 0) continue;
      grown[next] = 1;
      front.push_back(static_cast<Index>(next));
    }
  }
  return grown;
}

/// The gap that a point keeps in the capture pose: the margin, or its gap there where that is less. Of an overlap a
/// part is given back, so that where the grid's error differs from place to place it cannot grow.
float captured_gap(float distance, float margin) {
  return std::min(margin, distance < 0 ? distance * static_cast<float>(1 - overlap_given_back) : distance);
}

/// Where a muscle grows out of a bone it leaves as steeply as at rest, and an edge that passes through a ridge there
/// passes no deeper in its middle. Between ends inside, or one inside and one free, the middle would be deep in the
/// bone on the line between their gaps; and the sag of an edge is that of its deepest point, wherever that is.
std::vector<EdgeMiddle> middles_of_kept(const PreparedMuscle& prepared, const DistanceField& field,
                                        const FieldContactSet& contact, const std::vector<char>& keeps) {
  std::vector<EdgeMiddle> middles;
  const std::vector<float>& gaps = contact.captured.particle;
  const auto stays_inside = [&](Index p) {
    return keeps[static_cast<std::size_t>(p)] && gaps[static_cast<std::size_t>(p)] < 0;
  };
  const auto is_free = [&](Index p) { return prepared.fixed_body[static_cast<std::size_t>(p)] < 0; };
  const DistanceSet& edges = prepared.system.distances;
  for (std::size_t slot = 0; slot < edges.a.size(); ++slot) {
    const Index a = edges.a[slot], b = edges.b[slot];
    if (std::max(a, b) >= prepared.rest.cols()) continue;  // padding
    const float sag = contact.released.edge_sag[slot];
    if (!(stays_inside(a) || stays_inside(b) || sag < 0) || !(is_free(a) || is_free(b))) continue;
    const Vec3 middle = (prepared.rest.col(a) + prepared.rest.col(b)) / 2;
    const float gap = captured_gap(sample(field, Eigen::Vector3f(middle.cast<float>())).distance, 0);
    if (gap > (gaps[static_cast<std::size_t>(a)] + gaps[static_cast<std::size_t>(b)]) / 2 + sag)
      middles.push_back({a, b, gap});
  }
  return middles;
}

/// How far the segment or triangle between `corners` comes below the plane of its corners' gaps at rest, at most 0.
template <std::size_t N>
float sag_of(const PreparedMuscle& prepared, const DistanceField& field, const std::vector<float>& gaps,
             const std::array<Index, N>& corners) {
  float sag = 0;
  const auto look = [&](const std::array<int, N>& parts) {
    Vec3 q = Vec3::Zero();
    float gap = 0;
    for (std::size_t k = 0; k < N; ++k) {
      q += prepared.rest.col(corners[k]) * parts[k] / sag_parts;
      gap += gaps[static_cast<std::size_t>(corners[k])] * static_cast<float>(parts[k]) / sag_parts;
    }
    sag = std::min(sag, sample(field, Eigen::Vector3f(q.cast<float>())).distance - gap);
  };
  if constexpr (N == 2) {
    for (int i = 1; i < sag_parts; ++i) look({sag_parts - i, i});
  } else {
    for (int i = 1; i < sag_parts; ++i)
      for (int j = 1; i + j < sag_parts; ++j) look({sag_parts - i - j, i, j});
  }
  return sag;
}

/// Sags in the capture pose, and once released: none, except beside what keeps its overlap.
template <std::size_t N>
void add_sag(const PreparedMuscle& prepared, const FieldContactSet& contact, const std::vector<char>& keeps,
             const std::array<Index, N>& corners, std::vector<float>& captured, std::vector<float>& released) {
  const bool padding = corners[0] >= prepared.rest.cols();
  const bool tested = !padding && prepared.settings.bone_rest_gap;
  captured.push_back(tested ? sag_of(prepared, *contact.field.field, contact.captured.particle, corners) : 0);
  const bool kept = tested && std::any_of(corners.begin(), corners.end(),
                                          [&](Index p) { return keeps[static_cast<std::size_t>(p)] != 0; });
  released.push_back(kept ? captured.back() : 0);
}

/// Vertices near the bone at rest keep their distance there.
std::vector<float> ceilings(const PreparedMuscle& prepared, const std::vector<float>& distances, const Bone& bone) {
  if (prepared.settings.slide_on_bone != bone.name || bone.name.empty()) return {};
  std::vector<float> ceiling;
  const auto reach = static_cast<float>(prepared.settings.slide_reach);
  const auto margin = static_cast<float>(prepared.settings.bone_margin);
  for (float distance : distances)
    ceiling.push_back(distance <= reach ? std::max(distance, margin) : std::numeric_limits<float>::infinity());
  return ceiling;
}

}  // namespace

FieldContactSet bone_contact(const PreparedMuscle& prepared, const MeshTopology& topology, const Bone& bone,
                             const DistanceField& field) {
  const BoneContactSettings& settings = prepared.settings;
  const auto margin = static_cast<float>(settings.bone_margin);
  const auto cell = static_cast<float>(field.cell_size.maxCoeff());
  const std::vector<float> distances = rest_distances(prepared, field);
  FieldContactSet contact;
  contact.field = bounded(field);
  std::vector<char> keeps = grown_in(prepared, topology, distances);
  const DistanceSet& edges = prepared.system.distances;
  const FaceSet& faces = prepared.system.large_faces;
  for (ContactGaps* gaps : {&contact.captured, &contact.released}) {
    gaps->particle.reserve(distances.size());
    if (!settings.edge_contact) continue;
    gaps->edge_sag.reserve(edges.a.size());
    gaps->face_sag.reserve(faces.particles[0].size());
  }
  for (std::size_t p = 0; p < distances.size(); ++p) {
    keeps[p] |= prepared.fixed_body[p] >= 0;
    contact.captured.particle.push_back(settings.bone_rest_gap ? captured_gap(distances[p], margin) : margin);
    contact.released.particle.push_back(
        keeps[p] ? std::min(margin, contact.captured.particle.back() + given_back_by_kept * cell) : margin);
  }
  contact.ceiling = ceilings(prepared, distances, bone);
  contact.guard = settings.tunnelling;
  if (!settings.edge_contact) return contact;
  for (std::size_t slot = 0; slot < edges.a.size(); ++slot)
    add_sag<2>(prepared, contact, keeps, {edges.a[slot], edges.b[slot]}, contact.captured.edge_sag,
               contact.released.edge_sag);
  for (std::size_t slot = 0; slot < faces.particles[0].size(); ++slot)
    add_sag<3>(prepared, contact, keeps, {faces.particles[0][slot], faces.particles[1][slot], faces.particles[2][slot]},
               contact.captured.face_sag, contact.released.face_sag);
  if (settings.bone_rest_gap) contact.middles = middles_of_kept(prepared, field, contact, keeps);
  return contact;
}

}  // namespace gracilis::xpbd
