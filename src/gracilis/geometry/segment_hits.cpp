#include <gracilis/geometry/segment_hits.hpp>

#include <gracilis/geometry/measures.hpp>

#include <embree3/rtcore.h>

namespace gracilis {

struct SegmentHits::Tree {
  Vec3 place = Vec3::Zero();  ///< of Embree's origin: what is single precision is about here
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~Tree() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

SegmentHits::SegmentHits(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>()) {
  tree_->place = bounding_box(mesh.vertices).center();
  tree_->device = rtcNewDevice(nullptr);
  tree_->scene = rtcNewScene(tree_->device);
  rtcSetSceneFlags(tree_->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(tree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices =
      static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                  3 * sizeof(float), static_cast<std::size_t>(mesh.vertex_count())));
  Eigen::Map<Eigen::Matrix3Xf>(vertices, 3, mesh.vertex_count()) =
      (mesh.vertices.colwise() - tree_->place).cast<float>();
  auto* faces = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                               3 * sizeof(unsigned),
                                                               static_cast<std::size_t>(mesh.face_count())));
  Eigen::Map<Eigen::Matrix<unsigned, 3, Eigen::Dynamic>>(faces, 3, mesh.face_count()) = mesh.faces.cast<unsigned>();
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(tree_->scene, geometry);
  rtcReleaseGeometry(geometry);  // the scene holds it
  rtcCommitScene(tree_->scene);
}

SegmentHits::~SegmentHits() = default;
SegmentHits::SegmentHits(SegmentHits&&) noexcept = default;
SegmentHits& SegmentHits::operator=(SegmentHits&&) noexcept = default;

/// The segment, about Embree's origin, as a ray of the length 1 in its own unit.
static RTCRay ray_along(const Vec3& a, const Vec3& b) {
  const Eigen::Vector3f from = a.cast<float>(), along = (b - a).cast<float>();
  RTCRay ray{};
  ray.org_x = from.x();
  ray.org_y = from.y();
  ray.org_z = from.z();
  ray.dir_x = along.x();
  ray.dir_y = along.y();
  ray.dir_z = along.z();
  ray.tfar = 1;
  ray.mask = 0xffffffffu;
  return ray;
}

bool SegmentHits::cut(const Vec3& a, const Vec3& b) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = ray_along(a - tree_->place, b - tree_->place);
  rtcOccluded1(tree_->scene, &context, &ray);
  return ray.tfar < 0;
}

std::optional<SegmentHits::Hit> SegmentHits::first(const Vec3& a, const Vec3& b) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit seen{};
  seen.ray = ray_along(a - tree_->place, b - tree_->place);
  seen.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(tree_->scene, &context, &seen);
  if (seen.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{static_cast<Index>(seen.hit.primID), a + static_cast<Real>(seen.ray.tfar) * (b - a)};
}

}  // namespace gracilis
