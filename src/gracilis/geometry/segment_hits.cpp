#include <gracilis/geometry/segment_hits.hpp>

#include <gracilis/geometry/embree_scene.hpp>

namespace gracilis {

struct SegmentHits::Tree {
  EmbreeScene embree;
};

SegmentHits::SegmentHits(const TriangleMesh& mesh) : tree_(new Tree{EmbreeScene(mesh)}) {}

SegmentHits::~SegmentHits() = default;
SegmentHits::SegmentHits(SegmentHits&&) noexcept = default;
SegmentHits& SegmentHits::operator=(SegmentHits&&) noexcept = default;

bool SegmentHits::cut(const Vec3& a, const Vec3& b) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = ray_along(a - tree_->embree.place(), b - tree_->embree.place());
  rtcOccluded1(tree_->embree.get(), &context, &ray);
  return ray.tfar < 0;
}

std::optional<SegmentHits::Hit> SegmentHits::first(const Vec3& a, const Vec3& b) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit seen{};
  seen.ray = ray_along(a - tree_->embree.place(), b - tree_->embree.place());
  seen.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(tree_->embree.get(), &context, &seen);
  if (seen.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{static_cast<Index>(seen.hit.primID), a + static_cast<Real>(seen.ray.tfar) * (b - a)};
}

}  // namespace gracilis
