#include <gracilis/anatomy/attachments/attachment_reach.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/shortest_paths.hpp>

#include <algorithm>
#include <optional>

namespace gracilis {

namespace {

constexpr std::size_t most_poses = 60;

std::vector<const Pose*> evenly(const std::vector<Pose>& poses) {
  std::vector<const Pose*> taken;
  const std::size_t step = (poses.size() + most_poses - 1) / most_poses;
  for (std::size_t i = 0; i < poses.size(); i += step) taken.push_back(&poses[i]);
  taken.push_back(&poses.back());
  return taken;
}

/// Where the vertices of `attachment` are in the poses as `from` sees them: a column per pose, for each vertex.
std::vector<Points> seen_from(Index from, const Attachment& attachment, const Points& vertices,
                              const std::vector<const Pose*>& poses) {
  std::vector<Points> seen(attachment.vertices.size(), Points(3, static_cast<Index>(poses.size())));
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const std::vector<RigidTransform>& bodies = poses[k]->bodies;
    const RigidTransform relative =
        bodies[static_cast<std::size_t>(from)].inverse() * bodies[static_cast<std::size_t>(attachment.body)];
    for (std::size_t i = 0; i < seen.size(); ++i)
      seen[i].col(static_cast<Index>(k)) = relative * vertices.col(attachment.vertices[i]);
  }
  return seen;
}

Real farthest(const Points& points, const Vec3& from) { return (points.colwise() - from).colwise().norm().maxCoeff(); }

/// The ways over a surface, listed once somebody asks.
struct Ways {
  const TriangleMesh& surface;
  std::optional<EdgeGraph> graph;

  Eigen::VectorXd from(Index vertex) {
    if (!graph) graph = length_graph(surface.vertices, build_topology(surface.faces, surface.vertex_count()));
    return edge_distances(*graph, {vertex});
  }
};

/// Stretch of the surface between each vertex of `let_go` and the vertex of `keeper` that takes it furthest; 0 where
/// that is within reach.
std::vector<Real> stretches(const Attachment& let_go, const Attachment& keeper, const std::vector<const Pose*>& poses,
                            Ways& ways) {
  const Points& vertices = ways.surface.vertices;
  const std::vector<Points> seen = seen_from(keeper.body, let_go, vertices, poses);
  std::vector<Real> moved;
  for (std::size_t i = 0; i < seen.size(); ++i) moved.push_back(farthest(seen[i], vertices.col(let_go.vertices[i])));
  std::vector<Real> stretch(seen.size(), 0);
  for (const Index vertex : keeper.vertices) {
    const Vec3 place = vertices.col(vertex);
    Eigen::VectorXd along;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      // The way is no shorter than the straight line, and the distance grows by no more than the vertex moves.
      const Real straight = (vertices.col(let_go.vertices[i]) - place).norm();
      if (!(moved[i] > (longest_reach - 1) * straight)) continue;
      const Real distance = farthest(seen[i], place);
      if (!(distance > longest_reach * straight)) continue;
      if (along.size() == 0) along = ways.from(vertex);
      const Real way = along[let_go.vertices[i]];
      if (distance > longest_reach * way) stretch[i] = std::max(stretch[i], distance / way);
    }
  }
  return stretch;
}

std::vector<LetGo> let_go_beyond_reach(Muscle& muscle, const std::vector<const Pose*>& poses) {
  std::vector<LetGo> all;
  Ways ways{muscle.surface, {}};
  std::vector<Attachment>& attachments = muscle.attachments;
  for (std::size_t i = 0; i < attachments.size(); ++i)
    for (std::size_t j = i + 1; j < attachments.size(); ++j) {
      Attachment *larger = &attachments[i], *smaller = &attachments[j];
      if (larger->body == smaller->body || (larger->listed && smaller->listed)) continue;
      if (larger->listed || (!smaller->listed && larger->vertices.size() < smaller->vertices.size()))
        std::swap(larger, smaller);
      const std::vector<Real> stretch = stretches(*larger, *smaller, poses, ways);
      std::vector<Index> kept;
      for (std::size_t k = 0; k < stretch.size(); ++k)
        if (stretch[k] == 0) kept.push_back(larger->vertices[k]);
      if (kept.empty() || kept.size() == stretch.size()) continue;
      all.push_back({muscle.name, larger->name, smaller->name, static_cast<Index>(stretch.size() - kept.size()),
                     static_cast<Index>(stretch.size()), *std::max_element(stretch.begin(), stretch.end())});
      larger->vertices = std::move(kept);
    }
  return all;
}

}  // namespace

std::vector<LetGo> let_go_beyond_reach(Scene& scene, const std::vector<Pose>& poses) {
  if (poses.empty()) return {};
  const std::vector<const Pose*> taken = evenly(poses);
  std::vector<std::vector<LetGo>> each(scene.muscles.size());
  parallel_for_each(scene.muscles.size(),
                    [&](std::size_t m) { each[m] = let_go_beyond_reach(scene.muscles[m], taken); });
  std::vector<LetGo> all;
  for (const std::vector<LetGo>& some : each) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace gracilis
