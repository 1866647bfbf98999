#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/geometry/triangle_tree.hpp>

#include <limits>
#include <memory>

namespace gracilis {

/// The point of a surface nearest to a query point.
struct NearestPoint {
  Index face = -1;                  ///< -1: nothing within the distance asked for
  Vec3 barycentric = Vec3::Zero();  ///< of `point` in the face; zeros tell edges and corners
  Vec3 point = Vec3::Zero();
  Real distance = std::numeric_limits<Real>::infinity();
};

/// Answers nearest-point queries on a surface (a TriangleTree; distances in double precision).
/// Queries may run at the same time. Precondition: at least one face, all coordinates finite.
class NearestTriangle {
 public:
  explicit NearestTriangle(const TriangleMesh& mesh);  ///< copies it
  ~NearestTriangle();
  /// One that is moved from may only be assigned to or destroyed.
  NearestTriangle(NearestTriangle&&) noexcept;
  NearestTriangle& operator=(NearestTriangle&&) noexcept;  ///< as the constructor

  /// The nearest point within `reach`, or face -1.
  NearestPoint query(const Vec3& p, Real reach = std::numeric_limits<Real>::infinity()) const;
  /// The nearest point at any distance, found the faster the nearer the face `guess` is; the answer is the same.
  NearestPoint query_from(Index guess, const Vec3& p) const;

  /// What finds the triangles, for other questions about the surface.
  const TriangleTree& triangles() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace gracilis
