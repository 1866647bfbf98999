#include <gracilis/simulate/muscle_depths.hpp>

#include <gracilis/scene/attached_vertices.hpp>

#include <algorithm>

namespace gracilis {

static std::vector<TriangleMesh> surfaces_of(const Scene& scene) {
  std::vector<TriangleMesh> surfaces;
  for (const Muscle& muscle : scene.muscles) surfaces.push_back(muscle.surface);
  return surfaces;
}

static std::vector<std::vector<char>> attached_vertices_of(const Scene& scene) {
  std::vector<std::vector<char>> attached;
  for (const Muscle& muscle : scene.muscles) attached.push_back(attached_vertices(muscle));
  return attached;
}

MuscleDepths::MuscleDepths(const Scene& scene)
    : scene_(scene), attached_(attached_vertices_of(scene)), surfaces_(surfaces_of(scene)) {
  std::vector<Points> points;
  for (const Muscle& muscle : scene.muscles) points.push_back(muscle.surface.vertices);
  overlaps_.resize(points.size() * points.size());
  for (const DepthInOther& each : depths_of(points))
    overlaps_[pair_of(each)].push_back({place_at_rest(each), each.depth});
}

/// The same for both of a pair.
std::size_t MuscleDepths::pair_of(const DepthInOther& each) const {
  const auto [first, second] = std::minmax(each.surface, each.other);
  return static_cast<std::size_t>(first) * scene_.muscles.size() + static_cast<std::size_t>(second);
}

Vec3 MuscleDepths::place_at_rest(const DepthInOther& each) const {
  return scene_.muscles[static_cast<std::size_t>(each.surface)].surface.vertices.col(each.vertex);
}

/// Of free vertices only: attached ones go with their bones wherever these go.
std::vector<DepthInOther> MuscleDepths::depths_of(const std::vector<Points>& points) const {
  std::vector<DepthInOther> depths = surfaces_.find(points);
  std::erase_if(depths, [&](const DepthInOther& each) {
    return attached_[static_cast<std::size_t>(each.surface)][static_cast<std::size_t>(each.vertex)] != 0;
  });
  return depths;
}

std::vector<DepthBeyondRest> MuscleDepths::beyond_rest(const Frame& frame) const {
  std::vector<Points> points;
  for (const MuscleShape& muscle : frame.muscles) points.push_back(muscle.points);
  std::vector<DepthBeyondRest> beyond(points.size());
  for (const DepthInOther& each : depths_of(points)) {
    DepthBeyondRest& deepest = beyond[static_cast<std::size_t>(each.surface)];
    if (each.depth <= deepest.depth) continue;
    const Real depth = each.depth - deepest_around(overlaps_[pair_of(each)], place_at_rest(each));
    if (depth > deepest.depth) deepest = {depth, each.other};
  }
  return beyond;
}

}  // namespace gracilis
