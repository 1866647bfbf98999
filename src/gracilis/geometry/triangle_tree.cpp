#include <gracilis/geometry/triangle_tree.hpp>

#include <gracilis/geometry/measures.hpp>

#include <embree3/rtcore.h>

#include <new>
#include <stdexcept>

namespace gracilis {

namespace {

struct PointQuestion {
  TriangleTree::Near near;
  void* query;
};

/// Embree calls this for each triangle whose box meets the query sphere; shrinking the radius prunes the rest.
bool ask_near(RTCPointQueryFunctionArguments* arguments) {
  const auto& question = *static_cast<const PointQuestion*>(arguments->userPtr);
  const float radius = question.near(static_cast<Index>(arguments->primID), question.query);
  if (radius >= arguments->query->radius) return false;
  arguments->query->radius = radius;
  return true;
}

struct SegmentQuestion {
  RTCIntersectContext context;  ///< first, so that one is the other: Embree hands it on
  TriangleTree::Met met;
  void* query;
};

/// Tells of a triangle, and lets the segment run on.
void tell_met(const RTCFilterFunctionNArguments* arguments) {
  arguments->valid[0] = 0;
  const auto& question = *reinterpret_cast<const SegmentQuestion*>(arguments->context);
  question.met(static_cast<Index>(RTCHitN_primID(arguments->hit, arguments->N, 0)), question.query);
}

/// A segment, about Embree's origin, as a ray of the length 1 in its own unit.
RTCRay ray_along(const Vec3& a, const Vec3& b) {
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

/// Embree's calls throw nothing; the device keeps what went wrong in this thread. Without one, it is kept beside it.
void require_success(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot build a tree of triangles");
}

/// Room for so many triples, which the geometry keeps.
template <typename Number>
Eigen::Map<Eigen::Matrix<Number, 3, Eigen::Dynamic>> new_buffer(RTCDevice device, RTCGeometry geometry,
                                                                RTCBufferType type, RTCFormat format, Index count) {
  void* const data =
      rtcSetNewGeometryBuffer(geometry, type, 0, format, 3 * sizeof(Number), static_cast<std::size_t>(count));
  require_success(device);
  return {static_cast<Number*>(data), 3, count};
}

}  // namespace

struct TriangleTree::Tree {
  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
  };

  template <typename Object>
  using Owned = std::unique_ptr<std::remove_pointer_t<Object>, Release>;

  explicit Tree(const TriangleMesh& mesh) : place(bounding_box(mesh.vertices).center()) {
    device.reset(rtcNewDevice(nullptr));  // any number of threads asked for here would hold for the whole program
    require_success(device.get());
    scene.reset(rtcNewScene(device.get()));
    require_success(device.get());
    rtcSetSceneFlags(scene.get(),
                     static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    const Owned<RTCGeometry> geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    require_success(device.get());
    new_buffer<float>(device.get(), geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertex_count()) =
        (mesh.vertices.colwise() - place).cast<float>();
    new_buffer<unsigned>(device.get(), geometry.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.face_count()) =
        mesh.faces.cast<unsigned>();
    rtcSetGeometryPointQueryFunction(geometry.get(), ask_near);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene.get(), geometry.get());  // which keeps it
    rtcCommitScene(scene.get());
    require_success(device.get());
  }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  RTCRay ray(const Vec3& a, const Vec3& b) const { return ray_along(a - place, b - place); }

  Vec3 place;  ///< of Embree's origin, m
  Owned<RTCDevice> device;
  Owned<RTCScene> scene;
};

TriangleTree::TriangleTree(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>(mesh)) {}

TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

void TriangleTree::near(const Vec3& p, float radius, Near near, void* query) const {
  const Eigen::Vector3f at = (p - tree_->place).cast<float>();
  RTCPointQuery sphere;
  sphere.x = at.x();
  sphere.y = at.y();
  sphere.z = at.z();
  sphere.time = 0;
  sphere.radius = radius;
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  PointQuestion question{near, query};
  rtcPointQuery(tree_->scene.get(), &sphere, &context, nullptr, &question);
}

bool TriangleTree::cut(const Vec3& a, const Vec3& b) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = tree_->ray(a, b);
  rtcOccluded1(tree_->scene.get(), &context, &ray);
  return ray.tfar < 0;
}

std::optional<TriangleTree::Hit> TriangleTree::first(const Vec3& a, const Vec3& b) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit seen{};
  seen.ray = tree_->ray(a, b);
  seen.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(tree_->scene.get(), &context, &seen);
  if (seen.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{static_cast<Index>(seen.hit.primID), a + static_cast<Real>(seen.ray.tfar) * (b - a)};
}

void TriangleTree::all(const Vec3& a, const Vec3& b, Met met, void* query) const {
  SegmentQuestion question{{}, met, query};
  rtcInitIntersectContext(&question.context);
  question.context.filter = tell_met;
  RTCRay ray = tree_->ray(a, b);
  rtcOccluded1(tree_->scene.get(), &question.context, &ray);
}

}  // namespace gracilis
