#include <gracilis/dynamics/contact/surface/penetration_repair.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/mesh/edge_spread.hpp>
#include <gracilis/geometry/winding_number.hpp>

#include <algorithm>
#include <map>

namespace gracilis {

namespace {

/// What lies so much deeper in another surface than the two did around it at rest is taken out, m.
constexpr float tolerated_depth = 0.0005f;
/// How far along the surface others go along with a particle, over how far it goes itself.
constexpr float blended_over = 4;

/// Where a particle has to go, m.
struct Displacement {
  Index particle;
  Eigen::Vector3f by;
};

/// One side of a pair, seen from the other.
struct ProbeAndTarget {
  const ContactSurface& target_surface;
  const Eigen::Matrix3Xf& target_normals;
  const Particles &probe, &target;
  Eigen::Vector3f shift;              ///< from the probe's coordinates to the target's
  const std::vector<float>& deepest;  ///< m, of what lies in the other at rest around each of the probe's particles
};

/// By the winding number: beside a fold the nearest point alone does not tell inside from outside.
bool is_inside(const Eigen::Vector3f& p, const ContactSurface& surface, const Particles& particles) {
  Real winding = 0;
  const auto corner = [&](Index face, int at) -> Vec3 {
    return particles.position(surface.faces(at, face)).cast<Real>();
  };
  for (Index face = 0; face < surface.faces.cols(); ++face)
    winding += solid_angle_share(p.cast<Real>(), corner(face, 0), corner(face, 1), corner(face, 2));
  return winding > 0.5;
}

/// What of the probe's particles near the target lies deep in it, and what of the target gives way.
void gather_deep(const std::vector<VertexFaceCandidate>& near, const ProbeAndTarget& sides,
                 std::vector<Displacement>& of_probe, std::vector<Displacement>& of_target) {
  for (const VertexFaceCandidate& candidate : near) {
    const float at_rest = depth_at_rest(sides.deepest, candidate.particle);
    if (!(candidate.distance < -at_rest - tolerated_depth) || !(sides.probe.inverse_mass(candidate.particle) > 0))
      continue;
    const Eigen::Vector3f p = sides.probe.position(candidate.particle) + sides.shift;
    const PointGap gap = point_gap(p, sides.target_surface, NearestFace{candidate.face, candidate.barycentric},
                                   sides.target, sides.target_normals);
    const float missing = -at_rest - gap.distance;
    if (!(missing > tolerated_depth) || !is_inside(p, sides.target_surface, sides.target)) continue;
    const bool both_move = can_move(sides.target_surface, candidate.face, sides.target);
    const Eigen::Vector3f way = (both_move ? 0.5f : 1.0f) * missing * gap.normal;
    of_probe.push_back({candidate.particle, way});
    if (!both_move) continue;
    for (const Index corner : sides.target_surface.faces.col(candidate.face)) of_target.push_back({corner, -way});
  }
}

/// Adds what goes along with a particle to what goes already; of two ways the longer one counts.
void blend(const ContactSurface& surface, const Eigen::Matrix3Xf& rest, const Displacement& displacement,
           std::map<Index, Eigen::Vector3f>& all) {
  const float radius = blended_over * displacement.by.norm();
  const auto length = [&](Index from, Index to) { return (rest.col(to) - rest.col(from)).norm(); };
  const auto limit = [&](Index) { return radius; };
  spread_along_edges(surface, {{0.0f, displacement.particle}}, length, limit, [&](Index particle, float distance) {
    const Eigen::Vector3f by = (1 - distance / radius) * displacement.by;
    Eigen::Vector3f& kept = all.try_emplace(particle, Eigen::Vector3f::Zero()).first->second;
    if (by.squaredNorm() > kept.squaredNorm()) kept = by;
  });
}

}  // namespace

std::vector<char> repair_penetrations(const ContactWorld& world, const ContactWorldState& state,
                                      const std::vector<Particles*>& particles) {
  std::vector<std::vector<Displacement>> displacements(world.surfaces.size());
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    const SurfacePair& pair = world.pairs[i];
    if (pair.is_self()) continue;
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    gather_deep(state.candidates[i].near_second,
                {world.surfaces[b], state.normals[b], *particles[a], *particles[b], pair.shift, pair.first_deepest},
                displacements[a], displacements[b]);
    gather_deep(state.candidates[i].near_first,
                {world.surfaces[a], state.normals[a], *particles[b], *particles[a], -pair.shift, pair.second_deepest},
                displacements[b], displacements[a]);
  }
  std::vector<char> moved(displacements.size());
  std::transform(displacements.begin(), displacements.end(), moved.begin(),
                 [](const std::vector<Displacement>& each) { return !each.empty(); });
  if (std::none_of(moved.begin(), moved.end(), [](char each) { return each != 0; })) return {};
  parallel_for_each(displacements.size(), [&](std::size_t s) {
    std::map<Index, Eigen::Vector3f> all;
    for (const Displacement& each : displacements[s]) blend(world.surfaces[s], world.rest[s], each, all);
    for (const auto& [particle, by] : all)
      if (particles[s]->inverse_mass(particle) > 0) particles[s]->position(particle) += by;
  });
  return moved;
}

}  // namespace gracilis
