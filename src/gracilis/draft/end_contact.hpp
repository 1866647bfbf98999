#pragma once

#include <gracilis/draft/sites.hpp>
#include <gracilis/geometry/shortest_paths.hpp>
#include <gracilis/geometry/topology.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// Vertices of a muscle that an end may hold.
struct HeldVertices {
  std::vector<Index> vertices;     ///< ascending; empty: none
  std::vector<std::size_t> bones;  ///< that they are near to, in FoundFolder::bones
  Real distance = 0;               ///< m, within which they lie
};

/// What several questions about one muscle share.
class MuscleEnds {
 public:
  /// `surface` must outlive it; `size` is the body's, m.
  MuscleEnds(const TriangleMesh& surface, Real size);

  /// Vertices within the least of some distances to the zones at which they are enough to hold by; scattered ones are
  /// left out. Nothing where there are not enough within the largest.
  HeldVertices touching(const BoneParts& bones, const std::vector<Zone>& zones) const;
  /// The vertices nearest to the zones, however far.
  HeldVertices nearest(const BoneParts& bones, const std::vector<Zone>& zones) const;
  /// The end of the surface farthest from some of its vertices, on the way along it.
  HeldVertices farthest(const std::vector<Index>& from) const;
  /// Of each vertex, how far it is on the way from the first of both_ends() to the second, 0 to 1.
  Eigen::VectorXd share_between_ends() const;
  /// Both ends: of a vertex farthest from any, and farthest from that one.
  std::vector<HeldVertices> both_ends() const;

  /// Whether so many vertices, with so much of the surface around them, are enough to hold by.
  bool is_enough(const std::vector<Index>& vertices) const;
  const TriangleMesh& surface() const { return surface_; }  ///< m

 private:
  std::vector<Index> without_crumbs(const std::vector<Index>& vertices) const;
  HeldVertices end_about(const Eigen::VectorXd& ways) const;

  const TriangleMesh& surface_;
  Real size_;
  MeshTopology topology_;
  EdgeGraph graph_;
  Eigen::VectorXd areas_;
};

}  // namespace gracilis
