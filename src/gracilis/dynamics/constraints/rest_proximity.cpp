#include <gracilis/dynamics/constraints/rest_proximity.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/mesh/patch_tree.hpp>
#include <gracilis/dynamics/leverage.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace gracilis {

namespace {

constexpr Index faces_per_task = 256;
/// Nearer than this even what touched at rest is not allowed, m: well above what float tells apart.
constexpr Real least_gap = 3e-6;
/// Half of a distance at rest may be used up.
constexpr Real kept_share = 0.5;
/// What is so far on the wrong side did not get there over this place, m.
constexpr float lost = 3e-4f;

bool has(const Eigen::Vector3i& face, Index vertex) { return (face.array() == vertex).any(); }

/// How far p is out of the triangle, and its barycentric coordinates there. False for triangles without an area.
template <class S>
bool over_face(const Eigen::Matrix<S, 3, 1>& p, const std::array<Eigen::Matrix<S, 3, 1>, 3>& x, S& height,
               Eigen::Matrix<S, 3, 1>& weights, Eigen::Matrix<S, 3, 1>& normal) {
  normal = (x[1] - x[0]).cross(x[2] - x[0]);
  const S area2 = normal.squaredNorm();
  if (!(area2 > 0)) return false;
  weights[0] = (x[1] - p).cross(x[2] - p).dot(normal) / area2;
  weights[1] = (x[2] - p).cross(x[0] - p).dot(normal) / area2;
  weights[2] = 1 - weights[0] - weights[1];
  normal /= std::sqrt(area2);
  height = normal.dot(p - x[0]);
  return true;
}

/// How far edge a passes edge b along a × b, and where. False for nearly parallel ones.
template <class S>
bool over_edge(const std::array<Eigen::Matrix<S, 3, 1>, 2>& a, const std::array<Eigen::Matrix<S, 3, 1>, 2>& b,
               S& distance, S& s, S& t, Eigen::Matrix<S, 3, 1>& normal) {
  const Eigen::Matrix<S, 3, 1> along = a[1] - a[0], other = b[1] - b[0], between = a[0] - b[0];
  normal = along.cross(other);
  const S across2 = normal.squaredNorm();
  if (!(across2 > S(1e-4) * along.squaredNorm() * other.squaredNorm())) return false;
  s = other.cross(between).dot(normal) / across2;
  t = along.cross(between).dot(normal) / across2;
  normal /= std::sqrt(across2);
  distance = normal.dot(between);
  return true;
}

/// Looks at pairs of faces and appends what is tight between them.
struct Finder {
  const Points& vertices;
  const Eigen::Matrix3Xi& faces;
  const Particles& rest;
  Real reach;
  std::vector<RestProximity>& found;

  void look_at(Index first, Index second) {
    const Eigen::Vector3i a = faces.col(first), b = faces.col(second);
    if (box_of(a).squaredExteriorDistance(box_of(b)) > reach * reach) return;
    for (const Index p : a)
      if (!has(b, p)) add_point(p, b);
    for (const Index p : b)
      if (!has(a, p)) add_point(p, a);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) add_edges({a[i], a[(i + 1) % 3]}, {b[j], b[(j + 1) % 3]});
  }

 private:
  Eigen::AlignedBox3d box_of(const Eigen::Vector3i& face) const {
    Eigen::AlignedBox3d box(vertices.col(face[0]));
    return box.extend(vertices.col(face[1])).extend(vertices.col(face[2]));
  }

  void add(RestProximity place, Real distance) {
    float mobility = 0;
    for (const Index p : place.probe)
      if (p >= 0) mobility += rest.inverse_mass(p);
    for (const Index p : place.target)
      if (p >= 0) mobility += rest.inverse_mass(p);
    if (!(mobility > 0)) return;
    place.side = distance < 0 ? -1.0f : 1.0f;
    place.gap = static_cast<float>(std::max(least_gap, kept_share * std::abs(distance)));
    found.push_back(place);
  }

  void add_point(Index p, const Eigen::Vector3i& corners) {
    Vec3 weights, normal;
    Real height = 0;
    if (!over_face<Real>(vertices.col(p),
                         {vertices.col(corners[0]), vertices.col(corners[1]), vertices.col(corners[2])}, height,
                         weights, normal))
      return;
    if (std::abs(height) <= reach && weights.minCoeff() >= 0)
      add({{p, -1}, {corners[0], corners[1], corners[2]}}, height);
  }

  void add_edges(std::array<Index, 2> a, std::array<Index, 2> b) {
    if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]) return;
    std::sort(a.begin(), a.end()), std::sort(b.begin(), b.end());
    if (b < a) std::swap(a, b);
    Real distance = 0, s = 0, t = 0;
    Vec3 normal;
    if (!over_edge<Real>({vertices.col(a[0]), vertices.col(a[1])}, {vertices.col(b[0]), vertices.col(b[1])}, distance,
                         s, t, normal))
      return;
    if (std::abs(distance) <= reach && std::min(s, t) >= 0 && std::max(s, t) <= 1) add({a, {b[0], b[1], -1}}, distance);
  }
};

/// Moves both sides along the normal.
void push_apart(const RestProximity& place, const Eigen::Vector2f& probe_weights, const Eigen::Vector3f& target_weights,
                const Eigen::Vector3f& along, float wanted, Particles& particles) {
  float weight = 0, largest = 0;
  const auto add = [&](Index particle, float share) {
    if (particle < 0) return;
    weight += share * share * particles.inverse_mass(particle);
    largest = std::max(largest, share * particles.inverse_mass(particle));
  };
  for (int i = 0; i < 2; ++i) add(place.probe[i], probe_weights[i]);
  for (int i = 0; i < 3; ++i) add(place.target[i], target_weights[i]);
  weight = limit_leverage(weight, largest);
  if (!(weight > 0)) return;
  const Eigen::Vector3f push = wanted / weight * along;
  for (int i = 0; i < 2; ++i)
    if (place.probe[i] >= 0)
      particles.position(place.probe[i]) += particles.inverse_mass(place.probe[i]) * probe_weights[i] * push;
  for (int i = 0; i < 3; ++i)
    if (place.target[i] >= 0)
      particles.position(place.target[i]) -= particles.inverse_mass(place.target[i]) * target_weights[i] * push;
}

bool project_point(const RestProximity& place, Particles& particles) {
  float height = 0;
  Eigen::Vector3f weights, normal;
  if (!over_face<float>(particles.position(place.probe[0]),
                        {particles.position(place.target[0]), particles.position(place.target[1]),
                         particles.position(place.target[2])},
                        height, weights, normal))
    return false;
  const float wanted = place.gap - place.side * height;
  if (!(wanted > 0) || wanted > lost || weights.minCoeff() < 0) return false;
  push_apart(place, {1, 0}, weights, place.side * normal, wanted, particles);
  return true;
}

bool project_edges(const RestProximity& place, Particles& particles) {
  float distance = 0, s = 0, t = 0;
  Eigen::Vector3f normal;
  if (!over_edge<float>({particles.position(place.probe[0]), particles.position(place.probe[1])},
                        {particles.position(place.target[0]), particles.position(place.target[1])}, distance, s, t,
                        normal))
    return false;
  const float wanted = place.gap - place.side * distance;
  if (!(wanted > 0) || wanted > lost || std::min(s, t) < 0 || std::max(s, t) > 1) return false;
  push_apart(place, {1 - s, s}, {1 - t, t, 0}, place.side * normal, wanted, particles);
  return true;
}

}  // namespace

std::vector<RestProximity> find_rest_proximities(const Points& vertices, const Eigen::Matrix3Xi& faces, Real reach,
                                                 const Particles& rest) {
  const ContactSurface surface = build_contact_surface(faces, rest.count());
  const Eigen::Matrix3Xf points = positions_of(rest);
  PatchTree tree = build_patch_tree(surface, points);
  refit(surface, rest, tree);
  std::vector<RestProximity> places = collect_in_order<RestProximity>(
      faces.cols(), faces_per_task, [&](Index begin, Index end, std::vector<RestProximity>& part) {
        Finder finder{vertices, faces, rest, reach, part};
        std::vector<Index> patches;
        for (Index face = begin; face < end; ++face) {
          PatchTree::Bounds bounds;
          for (const Index corner : faces.col(face)) bounds.places.extend(Eigen::Vector3f(points.col(corner)));
          bounds.normals.low.setConstant(-1), bounds.normals.high.setConstant(1);  // whichever way they face
          patches.clear();
          gather_patches(tree, bounds, static_cast<float>(reach), patches);
          for (const Index patch : patches) {
            const PatchTree::Node& node = tree.nodes[static_cast<std::size_t>(patch)];
            for (Index i = node.begin; i < node.end; ++i)
              if (const Index other = tree.faces[static_cast<std::size_t>(i)]; other > face)
                finder.look_at(face, other);
          }
        }
      });
  // Neighboring pairs of faces find the same place.
  const auto key = [](const RestProximity& place) { return std::tie(place.probe, place.target); };
  std::sort(places.begin(), places.end(),
            [&](const RestProximity& l, const RestProximity& r) { return key(l) < key(r); });
  places.erase(std::unique(places.begin(), places.end(),
                           [&](const RestProximity& l, const RestProximity& r) { return key(l) == key(r); }),
               places.end());
  return places;
}

Index project_rest_proximities(const std::vector<RestProximity>& places, Particles& particles) {
  Index count = 0;
  for (const RestProximity& place : places)
    count += place.probe[1] < 0 ? project_point(place, particles) : project_edges(place, particles);
  return count;
}

}  // namespace gracilis
