#include <gracilis/dynamics/self_contact.hpp>

namespace gracilis {

/// Parts of a surface that lie back to back farther apart than this at rest, in neighborhoods, meet from outside.
static constexpr float thickest_sheet = 2;

float SelfRule::side(Index particle, Index face) const {
  Eigen::Vector3f outward = Eigen::Vector3f::Zero();
  const auto at = static_cast<std::size_t>(particle);
  for (Index i = surface.fan_offsets[at]; i < surface.fan_offsets[at + 1]; ++i)
    outward += face_area(surface, surface.fan[static_cast<std::size_t>(i)], particles);
  return face_area(surface, face, particles).dot(outward) < 0 ? side_at_rest(particle, face) : 0;
}

float SelfRule::side_at_rest(Index particle, Index face) const {
  const Eigen::Vector3i corners = surface.faces.col(face);
  if (corners[0] == particle || corners[1] == particle || corners[2] == particle) return 0;
  const auto own = rest_normals.col(particle);
  Eigen::Vector3f away = rest.col(corners[0]) - rest.col(particle);  // to the nearest corner
  // Most are neighbors on the same side.
  if (away.squaredNorm() < neighborhood * neighborhood && own.dot(rest_normals.col(corners[0])) > 0.6f) return 0;
  for (const Index corner : {corners[1], corners[2]}) {
    const Eigen::Vector3f other = rest.col(corner) - rest.col(particle);
    if (other.squaredNorm() < away.squaredNorm()) away = other;
  }
  const Eigen::Vector3f rest_facing =
      rest_normals.col(corners[0]) + rest_normals.col(corners[1]) + rest_normals.col(corners[2]);
  const float neighborhoods = away.norm() / neighborhood;
  const bool through = away.dot(own) < 0 && away.dot(rest_facing) > 0 && neighborhoods < thickest_sheet;
  const bool alike = rest_facing.dot(own) > 1.5f;
  if (through && !alike) return -1;
  return neighborhoods > 1 ? 1.0f : 0.0f;
}

SelfRule self_rule(const SurfaceCrowd& crowd, const Particles& particles, Index surface) {
  const auto at = static_cast<std::size_t>(surface);
  return {crowd.surfaces[at], crowd.rest[at], crowd.rest_normals[at], particles, crowd.neighborhood[at]};
}

}  // namespace gracilis
