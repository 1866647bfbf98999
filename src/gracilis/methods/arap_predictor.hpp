#pragma once

#include <gracilis/geometry/arap_surface.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <functional>
#include <vector>

namespace gracilis {

/// What `predictor = "arap"` brings the vertices nearer to before a solver begins: an as-rigid-as-possible surface held
/// at its attachments, with its volume, and out of bones. Never changes.
class ArapPredictor {
 public:
  /// `held` is 1 for vertices whose places are given.
  ArapPredictor(const TriangleMesh& rest, const MeshTopology& topology, std::vector<char> held);

  /// A few rounds of rotations, places, volume and contact, as the method `arap` takes them; `push_out` brings points
  /// (3 × vertices, m) out of bones.
  void bring_nearer(const std::function<void(Points&)>& push_out, Points& points) const;

 private:
  std::vector<char> held_;
  Eigen::Matrix3Xi faces_;
  Real volume_;  ///< m³, at rest
  arap::Surface surface_;
};

}  // namespace gracilis
