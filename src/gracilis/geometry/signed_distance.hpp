#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/winding_number.hpp>

#include <optional>
#include <vector>

namespace gracilis {

/// Exact distance to a surface, negative inside. On closed, consistently oriented surfaces the sign is that of the
/// angle-weighted pseudonormal at the nearest point (Bærentzen and Aanæs 2005); on others, which have holes, and where
/// the surface is folded over itself or passes through itself, the point is inside where the generalized winding number
/// exceeds 1/2.
class SignedDistance {
 public:
  /// Precondition: at least one face, finite coordinates, oriented outwards.
  explicit SignedDistance(const TriangleMesh& mesh);

  struct Answer {
    Real distance = std::numeric_limits<Real>::infinity();  ///< m, negative inside
    NearestPoint nearest;
  };

  /// Answers with +infinity and face -1 when the surface is farther than `reach`.
  Answer query(const Vec3& p, Real reach = std::numeric_limits<Real>::infinity()) const;

  /// The answer at any distance, found the faster the nearer the face `guess` is; the same with any.
  Answer query_from(Index guess, const Vec3& p) const;

  bool closed() const { return closed_; }  ///< closed, and consistently oriented

 private:
  Vec3 pseudonormal(const NearestPoint& nearest) const;
  Answer with_sign(const NearestPoint& nearest, const Vec3& p) const;

  void find_doubtful(const TriangleMesh& mesh, const std::vector<MeshEdge>& edges);

  Eigen::Matrix3Xi faces_;
  bool closed_ = false;
  NearestTriangle nearest_triangle_;
  std::optional<WindingNumber> winding_;  ///< only where normals do not tell
  std::vector<char> doubtful_;            ///< of a closed surface's faces: those whose normals do not tell
  Points face_normals_;                   ///< unit
  Points vertex_normals_;                 ///< angle-weighted
  Points edge_normals_;                   ///< column 3 f + k: edge k → k+1 of face f
};

/// The share of a surface's vertices that lie nearer than `reach` (m) to another surface, or inside it; of about
/// `samples` of them, spread over the surface. 0 where it has none.
Real share_within(const TriangleMesh& mesh, const SignedDistance& other, Real reach, Index samples);

}  // namespace gracilis
