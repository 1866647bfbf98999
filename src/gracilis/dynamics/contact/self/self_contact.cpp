#include <gracilis/dynamics/contact/self/self_contact.hpp>

#include <Eigen/Geometry>

namespace gracilis {

namespace {

/// Parts of a surface that lie back to back farther apart than this at rest, in neighborhoods, may meet from outside.
constexpr float thickest_sheet = 2;
/// Cosine between normals above which two parts are the same side of a surface.
constexpr float alike = 0.5f;
/// The share of their distance at rest that neighbors keep when they fold onto each other.
constexpr float kept_distance = 0.1f;

/// One part of a surface and the way it faces.
struct Part {
  Eigen::Vector3f place, normal;
};

/// 1 when each is in front of the other, -1 when each is behind, 0 when they do not tell the same.
float side_of(const Part& one, const Part& other) {
  const Eigen::Vector3f away = other.place - one.place;
  const float ahead = away.dot(one.normal), back = away.dot(other.normal);
  return ahead > 0 && back < 0 ? 1.0f : ahead < 0 && back > 0 ? -1.0f : 0.0f;
}

/// What the places at rest decide for good; 0: nothing.
float decided_at_rest(const Part& one, const Part& other, float neighborhood) {
  const float side = side_of(one, other), cosine = one.normal.dot(other.normal);
  if (side > 0) return cosine < 0 ? side : 0;
  const bool is_sheet = (other.place - one.place).norm() < thickest_sheet * neighborhood;
  return is_sheet && cosine < alike ? side : 0;
}

/// Of the surface around a particle, its area vectors' sum.
Eigen::Vector3f area_around(const ContactSurface& surface, const Particles& particles, Index particle) {
  return sum_around(surface, particle, [&](Index face) { return face_area(surface, face, particles); });
}

bool share_an_end(const std::array<Index, 2>& edge, const std::array<Index, 2>& other) {
  return edge[0] == other[0] || edge[0] == other[1] || edge[1] == other[0] || edge[1] == other[1];
}

/// The corner of a face that is nearest to a point.
Index nearest_corner(const Eigen::Vector3i& corners, const Eigen::Matrix3Xf& points, const Eigen::Vector3f& from) {
  Index nearest = corners[0];
  for (const Index corner : {corners[1], corners[2]})
    if ((points.col(corner) - from).squaredNorm() < (points.col(nearest) - from).squaredNorm()) nearest = corner;
  return nearest;
}

}  // namespace

float SelfRule::side(Index particle, Index face) const {
  return face_area(surface, face, particles).dot(area_around(surface, particles, particle)) < 0
             ? side_when_facing(particle, face)
             : 0;
}

float SelfRule::side_when_facing(Index particle, Index face) const {
  const Eigen::Vector3i corners = surface.faces.col(face);
  if ((corners.array() == static_cast<int>(particle)).any()) return 0;
  const Index corner = nearest_corner(corners, rest, rest.col(particle));
  const Eigen::Vector3f facing =
      (rest_normals.col(corners[0]) + rest_normals.col(corners[1]) + rest_normals.col(corners[2])) / 3;
  const float decided =
      decided_at_rest({rest.col(particle), rest_normals.col(particle)}, {rest.col(corner), facing}, neighborhood);
  if (decided != 0) return decided;
  const Eigen::Vector3f area = face_area(surface, face, before), p = before.position(particle);
  // Whether it was in front of or behind the face, right over it.
  if (area.dot(area_around(surface, before, particle)) < 0 &&
      nearest_on_face(p, surface, face, before).barycentric.minCoeff() > 0)
    return area.dot(p - before.position(corners[0])) < 0 ? -1.0f : 1.0f;
  // What comes from afar comes from outside.
  return (rest.col(corner) - rest.col(particle)).norm() > thickest_sheet * neighborhood ? 1.0f : 0.0f;
}

float SelfRule::side(const std::array<Index, 2>& edge, const std::array<Index, 2>& other) const {
  if (share_an_end(edge, other)) return 0;
  const auto middle = [](const Eigen::Matrix3Xf& points, const std::array<Index, 2>& ends) {
    return Eigen::Vector3f((points.col(ends[0]) + points.col(ends[1])) / 2);
  };
  const float decided = decided_at_rest({middle(rest, edge), middle(rest_normals, edge)},
                                        {middle(rest, other), middle(rest_normals, other)}, neighborhood);
  if (decided != 0) return decided;
  const auto normal = [&](const std::array<Index, 2>& ends) {
    return Eigen::Vector3f(area_around(surface, before, ends[0]) + area_around(surface, before, ends[1]));
  };
  const Eigen::Vector3f own = normal(edge), facing = normal(other);
  if (!(own.dot(facing) < 0)) return 0;
  const EdgeGap gap = edge_gap(before.position(edge[0]), before.position(edge[1]), before.position(other[0]),
                               before.position(other[1]), facing - own);
  return !gap.crossing ? 0.0f : gap.distance < 0 ? -1.0f : 1.0f;
}

float SelfRule::most_gap(Index particle, Index face) const {
  const Eigen::Vector3i corners = surface.faces.col(face);
  const Index corner = nearest_corner(corners, rest, rest.col(particle));
  return kept_distance * (rest.col(corner) - rest.col(particle)).norm();
}

float SelfRule::most_gap(const std::array<Index, 2>& edge, const std::array<Index, 2>& other) const {
  return kept_distance / 2 * (rest.col(other[0]) + rest.col(other[1]) - rest.col(edge[0]) - rest.col(edge[1])).norm();
}

}  // namespace gracilis
