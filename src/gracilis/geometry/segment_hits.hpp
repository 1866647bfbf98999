#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <memory>
#include <optional>

namespace gracilis {

/// Tells whether and where segments cut a surface (by a TriangleTree, in single precision). Queries may run at the same
/// time. Precondition: at least one face, all coordinates finite.
class SegmentHits {
 public:
  explicit SegmentHits(const TriangleMesh& mesh);
  ~SegmentHits();
  SegmentHits(SegmentHits&&) noexcept;
  SegmentHits& operator=(SegmentHits&&) noexcept;

  /// Whether the segment from a to b meets a triangle.
  bool cut(const Vec3& a, const Vec3& b) const;

  struct Hit {
    Index face = -1;
    Vec3 place;
  };
  /// Where the segment from a to b first meets a triangle; empty where it meets none.
  std::optional<Hit> first(const Vec3& a, const Vec3& b) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace gracilis
