#include <gracilis/geometry/segment_hits.hpp>

#include <gracilis/geometry/triangle_tree.hpp>

namespace gracilis {

struct SegmentHits::Tree {
  TriangleTree triangles;
};

SegmentHits::SegmentHits(const TriangleMesh& mesh) : tree_(new Tree{TriangleTree(mesh)}) {}

SegmentHits::~SegmentHits() = default;
SegmentHits::SegmentHits(SegmentHits&&) noexcept = default;
SegmentHits& SegmentHits::operator=(SegmentHits&&) noexcept = default;

bool SegmentHits::cut(const Vec3& a, const Vec3& b) const { return tree_->triangles.cut(a, b); }

std::optional<SegmentHits::Hit> SegmentHits::first(const Vec3& a, const Vec3& b) const {
  const std::optional<TriangleTree::Hit> hit = tree_->triangles.first(a, b);
  if (!hit) return std::nullopt;
  return Hit{hit->face, a + static_cast<Real>(hit->share) * (b - a)};
}

}  // namespace gracilis
