#include <gracilis/anatomy/activation/tendon.hpp>

#include <gracilis/geometry/shortest_paths.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

std::vector<Real> belly_shares(const Points& vertices, const MeshTopology& topology, const std::vector<Index>& attached,
                               Real tendon_length) {
  std::vector<Real> shares(static_cast<std::size_t>(vertices.cols()), 1);
  if (attached.empty() || !(tendon_length > 0)) return shares;
  const Eigen::VectorXd distances = edge_distances(length_graph(vertices, topology), attached);
  Real farthest = 0;
  for (const Real distance : distances)
    if (std::isfinite(distance)) farthest = std::max(farthest, distance);
  const Real tendon = std::min(tendon_length, farthest / 2);
  for (std::size_t v = 0; v < shares.size() && tendon > 0; ++v) {
    const Real t = std::min(distances[static_cast<Index>(v)] / tendon, Real{1});
    shares[v] = t * t * (3 - 2 * t);
  }
  return shares;
}

std::vector<Real> belly_shares(const Muscle& muscle, Real tendon_length) {
  std::vector<Index> attached;
  for (const Attachment& attachment : muscle.attachments)
    attached.insert(attached.end(), attachment.vertices.begin(), attachment.vertices.end());
  return belly_shares(muscle.surface.vertices, build_topology(muscle.surface.faces, muscle.surface.vertex_count()),
                      attached, tendon_length);
}

}  // namespace gracilis
