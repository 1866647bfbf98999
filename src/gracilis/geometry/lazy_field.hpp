#pragma once

#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/geometry/signed_distance.hpp>

#include <atomic>
#include <memory>

namespace gracilis {

/// Signed distances to one surface on a grid whose nodes are computed when somebody first asks near them, so that what
/// nobody comes near costs nothing. May be asked by several threads at once; answers do not depend on who asks first.
class LazyField {
 public:
  /// Cubic cells of `cell_size` (m), and `margin` (m) around the surface. `exact`, the surface's distances, must
  /// outlive this.
  LazyField(const TriangleMesh& surface, const SignedDistance& exact, Real cell_size, Real margin);

  /// Distance and gradient, trilinear between exact nodes. Further than 12 mm from the surface, or outside of the grid,
  /// a lower bound of the distance, without gradient.
  FieldSample sample(const Vec3& p) const;

 private:
  using Nodes = std::unique_ptr<std::atomic<float>[]>;
  float node(const Nodes& nodes, const Eigen::Vector3i& counts, Real cell, const Eigen::Vector3i& at) const;

  const SignedDistance* exact_;
  Eigen::AlignedBox3d box_;
  Real cell_;
  Eigen::Vector3i counts_, coarse_counts_;  ///< of nodes
  Nodes nodes_, coarse_;                    ///< nan where nobody asked yet
};

}  // namespace gracilis
