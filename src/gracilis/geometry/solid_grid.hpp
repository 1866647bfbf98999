#pragma once

#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/geometry/triangle_tree.hpp>

#include <array>
#include <optional>
#include <vector>

namespace gracilis {

/// Nodes of a cubic grid in a closed surface and so far around it that every point inside lies between eight of them:
/// what smooth fields inside a solid are given at. Sheets in the solid cut it: fields differ on their two sides.
class SolidGrid {
 public:
  /// An edge between neighboring nodes, and how much of it joins them: what of it lies inside, but a little outside,
  /// too, and next to nothing where a sheet cuts it.
  struct Edge {
    Index a, b;
    Real share;
  };
  /// The eight nodes around a point with the weights of trilinear interpolation; none where the grid does not reach.
  /// Nodes on the other side of a sheet weigh nothing.
  struct Place {
    std::array<Index, 8> nodes;
    std::array<Real, 8> weights;
    bool is_known = false;

    /// What vectors at the nodes (3 × count) come to here. Precondition: is_known.
    Vec3 mean(const Points& of_nodes) const {
      Vec3 sum = Vec3::Zero();
      for (std::size_t k = 0; k < 8; ++k) sum += weights[k] * of_nodes.col(nodes[k]);
      return sum;
    }
  };

  /// About `nodes_inside` nodes lie inside; `sheets` have no faces where there are none. Precondition: a closed
  /// surface, oriented outwards, with a volume.
  SolidGrid(const TriangleMesh& surface, const SignedDistance& distance, const TriangleMesh& sheets,
            Index nodes_inside);

  Index count() const { return static_cast<Index>(nodes_.cols()); }  ///< of nodes
  Real step() const { return step_; }                                ///< m between neighbors
  const Points& nodes() const { return nodes_; }                     ///< 3 × count
  const std::vector<Real>& depths() const { return depths_; }        ///< per node: how far inside, m; negative outside
  const std::vector<Edge>& edges() const { return edges_; }          ///< each once

  Place place(const Vec3& p) const;  ///< of a point, m
  /// How far inside a point is, by its nodes, m; -step where the grid does not reach. Errs by less than a step.
  Real depth(const Vec3& p) const;

 private:
  void join_neighbors();
  void cut_edges();
  void leave_out_far_side(const Vec3& p, Place& place) const;
  std::size_t at(Index i, Index j, Index k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size_[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(size_[1]) * static_cast<std::size_t>(k));
  }

  Vec3 low_ = Vec3::Zero();
  Real step_ = 1;
  std::array<Index, 3> size_{};
  std::vector<Index> numbers_;  ///< of the grid's places, x fastest: their node or -1
  Points nodes_;
  std::vector<Real> depths_;
  std::vector<Edge> edges_;
  std::optional<TriangleTree> sheets_;
  std::vector<char> is_cut_;  ///< per node: whether an edge of it is
};

}  // namespace gracilis
