#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// Points bound to a closed surface by mean value coordinates, so that they follow it when it deforms.
///
/// A surface's vertices are x = A r + t + d: r at rest, A and t the affine map that fits best (by area), d what is
/// left. A bound point then is A p + t + Σ w d, which is what the coordinates say, since they reproduce affine maps;
/// but the sum may now be rounded without harm. Vertices far from a point for their distance from each other
/// (`openness`) share one term: d is taken as linear over them, with the gradient that fits them best. This makes 1500
/// points on 10,000 vertices some hundred thousand terms instead of 15 million.
class SurfaceBinding {
 public:
  /// Binds the points (3 × k, m) to the surface at rest. Takes a millisecond per point and 10,000 vertices.
  /// `openness`: largest radius of a group of vertices over its distance that is taken as one; 0 takes every vertex on
  /// its own.
  SurfaceBinding(const TriangleMesh& surface, const Points& points, Real openness = 0.3);

  /// Where the points are when the surface's vertices are at `vertices` (3 × n): 3 × k. Deterministic for any number of
  /// threads.
  Points evaluate(const Points& vertices) const;

  std::size_t term_count() const { return terms_.size(); }  ///< of all points, what an evaluation takes

 private:
  /// A group of vertices: order_[begin] ... order_[end - 1], halved into two children that stand after it.
  struct Group {
    Index begin, end;
    Index second_child;  ///< the first is the next group; 0: none
    Vec3 center;
    Real radius;
    Vec3 mean;                       ///< of its vertices at rest
    Eigen::Matrix3f inverse_spread;  ///< of the second moments about it; zero along directions in which it is flat
  };
  struct Term {
    Index group;
    float weight;            ///< Σ w
    Eigen::Vector3f moment;  ///< Σ w (r - mean), m
  };

  Eigen::Matrix3f inverse_spread(Index begin, Index end, const Vec3& mean) const;
  void build_groups(const TriangleMesh& surface, Index begin, Index end);
  void add_terms(const Vec3& p, const Eigen::VectorXd& weights, Real openness, std::vector<Term>& terms) const;

  Points rest_, points_;
  Eigen::VectorXd shares_;   ///< of the surface's area, per vertex
  Vec3 center_;              ///< of the surface at rest, by area
  Eigen::Matrix3d inverse_;  ///< of the second moments about it
  std::vector<Index> order_;
  std::vector<Group> groups_;
  std::vector<std::size_t> offsets_;  ///< per point: where its terms begin
  std::vector<Term> terms_;
};

}  // namespace gracilis
