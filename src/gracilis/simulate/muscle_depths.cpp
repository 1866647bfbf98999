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

MuscleDepths::MuscleDepths(const Scene& scene) : attached_(attached_vertices_of(scene)), surfaces_(surfaces_of(scene)) {
  const auto count = static_cast<Index>(scene.muscles.size());
  at_rest_ = Eigen::MatrixXd::Zero(count, count);
  std::vector<Points> points;
  for (const Muscle& muscle : scene.muscles) points.push_back(muscle.surface.vertices);
  for (const DepthInOther& each : depths_of(points)) {
    const Real deepest = std::max(at_rest_(each.surface, each.other), each.depth);
    at_rest_(each.surface, each.other) = at_rest_(each.other, each.surface) = deepest;
  }
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
    const Real depth = each.depth - at_rest_(each.surface, each.other);
    if (depth > deepest.depth) deepest = {depth, each.other};
  }
  return beyond;
}

}  // namespace gracilis
