#include <gracilis/geometry/isocontours.hpp>

#include <gracilis/geometry/polylines.hpp>

#include <algorithm>

namespace gracilis {

Real closed_length(const Points& loop) {
  return polyline_length(loop) + (loop.col(0) - loop.col(loop.cols() - 1)).norm();
}

Points resampled_loop(const Points& loop, Index count) {
  Points closed(3, loop.cols() + 1);
  closed << loop, loop.col(0);
  return resampled(closed, count).leftCols(count);
}

std::vector<Points> isocontours(const TriangleMesh& surface, const MeshTopology& topology, const Eigen::VectorXd& field,
                                Real level) {
  // In each triangle that the level crosses, the line goes from the edge that falls below it to the one that rises
  // above it again; following this from edge to edge closes up.
  const auto above = [&](Index v) { return field[v] >= level; };
  std::vector<Index> next(topology.edges.size(), -1), of_face(3 * static_cast<std::size_t>(surface.face_count()), -1);
  std::vector<char> crossed(topology.edges.size(), 0);
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    const MeshEdge& edge = topology.edges[e];
    if (above(edge.a) == above(edge.b)) continue;
    crossed[e] = 1;
    // Left face sees a→b, right face b→a. A face is left through the edge that goes up in its own direction.
    const bool up = above(edge.b);
    for (const auto& [face, rises] : {std::pair{edge.left, up}, std::pair{edge.right, !up}})
      if (face >= 0) of_face[3 * static_cast<std::size_t>(face) + (rises ? 1 : 0)] = static_cast<Index>(e);
  }
  for (std::size_t f = 0; f < of_face.size(); f += 3)
    if (of_face[f] >= 0 && of_face[f + 1] >= 0) next[static_cast<std::size_t>(of_face[f])] = of_face[f + 1];

  std::vector<Points> loops;
  for (std::size_t first = 0; first < crossed.size(); ++first) {
    if (!crossed[first]) continue;
    std::vector<Vec3> line;
    for (Index e = static_cast<Index>(first); e >= 0 && crossed[static_cast<std::size_t>(e)];
         e = next[static_cast<std::size_t>(e)]) {
      crossed[static_cast<std::size_t>(e)] = 0;
      const MeshEdge& edge = topology.edges[static_cast<std::size_t>(e)];
      const Real share = (level - field[edge.a]) / (field[edge.b] - field[edge.a]);
      line.emplace_back(surface.vertices.col(edge.a) +
                        share * (surface.vertices.col(edge.b) - surface.vertices.col(edge.a)));
    }
    Points loop(3, static_cast<Index>(line.size()));
    for (std::size_t i = 0; i < line.size(); ++i) loop.col(static_cast<Index>(i)) = line[i];
    if (loop.cols() >= 3) loops.push_back(std::move(loop));
  }
  std::stable_sort(loops.begin(), loops.end(),
                   [](const Points& a, const Points& b) { return closed_length(a) > closed_length(b); });
  return loops;
}

}  // namespace gracilis
