#include <gracilis/dynamics/self_contact.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/point_triangle.hpp>

#include <algorithm>

namespace gracilis {

namespace {

constexpr Index patches_per_task = 64;
/// Parts of a surface that lie back to back farther apart than this at rest, in neighborhoods, meet from outside.
constexpr float thickest_sheet = 2;

/// The nearest of the faces that the particle, which faces along `outward`, may meet.
void find_nearest(const SelfRule& rule, Index particle, const Eigen::Vector3f& outward, const Eigen::Matrix3Xf& areas,
                  float reach, const std::vector<Index>& faces, std::vector<PointTouch>& found) {
  const Eigen::Vector3f p = rule.particles.position(particle);
  PointTouch nearest{particle, -1, 0};
  float least2 = reach * reach;
  for (const Index face : faces) {
    if (!(areas.col(face).dot(outward) < 0)) continue;
    const Eigen::Vector3i corners = rule.surface.faces.col(face);
    const Eigen::Vector3f a = rule.particles.position(corners[0]), b = rule.particles.position(corners[1]),
                          c = rule.particles.position(corners[2]);
    const Eigen::Vector3f low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    if ((low.array() - reach > p.array()).any() || (high.array() + reach < p.array()).any()) continue;
    const Eigen::Vector3f weights = nearest_barycentric(p, a, b, c);
    const float distance2 = (weights[0] * a + weights[1] * b + weights[2] * c - p).squaredNorm();
    // Ties go to the lower face, so that the answer does not depend on the tree.
    if (distance2 > least2 || (distance2 == least2 && nearest.face >= 0 && face > nearest.face)) continue;
    const float side = rule.side_at_rest(particle, face);
    if (side == 0) continue;
    least2 = distance2;
    nearest.face = face, nearest.side = side;
  }
  if (nearest.face >= 0) found.push_back(nearest);
}

}  // namespace

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

void find_self(const SelfRule& rule, float reach, PatchTree& tree, std::vector<PointTouch>& found) {
  const Eigen::Matrix3Xf areas = face_areas(rule.surface, rule.particles);
  const Eigen::Matrix3Xf outward = sums_around_particles(rule.surface, areas);
  refit(rule.surface, rule.particles, areas, tree);
  const auto count = static_cast<Index>(tree.patches.size());
  std::vector<std::vector<PointTouch>> parts(
      static_cast<std::size_t>((count + patches_per_task - 1) / patches_per_task));
  parallel_for(count, patches_per_task, [&](Index begin, Index end) {
    std::vector<PointTouch>& part = parts[static_cast<std::size_t>(begin / patches_per_task)];
    std::vector<Index> faces;
    for (Index patch = begin; patch < end; ++patch) {
      faces.clear();
      gather_faces(tree, bounds_of_particles(tree, patch, rule.particles, outward), reach, faces);
      if (faces.empty()) continue;
      const auto at = static_cast<std::size_t>(patch);
      for (Index i = tree.particle_offsets[at]; i < tree.particle_offsets[at + 1]; ++i) {
        const Index particle = tree.particles[static_cast<std::size_t>(i)];
        find_nearest(rule, particle, outward.col(particle), areas, reach, faces, part);
      }
    }
  });
  found.clear();
  for (const std::vector<PointTouch>& part : parts) found.insert(found.end(), part.begin(), part.end());
  std::sort(found.begin(), found.end(),
            [](const PointTouch& l, const PointTouch& r) { return l.particle < r.particle; });
}

}  // namespace gracilis
