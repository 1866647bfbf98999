#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <memory>

namespace gracilis {

/// Tells whether segments cut a surface (Embree's rays, in single precision). Queries may run at the same time.
/// Precondition: at least one face, all coordinates finite.
class SegmentHits {
 public:
  explicit SegmentHits(const TriangleMesh& mesh);
  ~SegmentHits();
  SegmentHits(SegmentHits&&) noexcept;
  SegmentHits& operator=(SegmentHits&&) noexcept;

  /// Whether the segment from a to b meets a triangle.
  bool cut(const Vec3& a, const Vec3& b) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace gracilis
