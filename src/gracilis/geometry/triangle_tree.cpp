#include <gracilis/geometry/triangle_tree.hpp>

#include <gracilis/geometry/measures.hpp>

#include <embree3/rtcore.h>

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

}  // namespace

struct TriangleTree::Tree {
  explicit Tree(const TriangleMesh& mesh) : place(bounding_box(mesh.vertices).center()) {
    device = rtcNewDevice(nullptr);  // any number of threads asked for here would hold for the whole program
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices =
        static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                    3 * sizeof(float), static_cast<std::size_t>(mesh.vertex_count())));
    Eigen::Map<Eigen::Matrix3Xf>(vertices, 3, mesh.vertex_count()) = (mesh.vertices.colwise() - place).cast<float>();
    auto* faces = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned),
                                                                 static_cast<std::size_t>(mesh.face_count())));
    Eigen::Map<Eigen::Matrix<unsigned, 3, Eigen::Dynamic>>(faces, 3, mesh.face_count()) = mesh.faces.cast<unsigned>();
    rtcSetGeometryPointQueryFunction(geometry, ask_near);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);  // the scene keeps it
    rtcCommitScene(scene);
  }
  ~Tree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  RTCRay ray(const Vec3& a, const Vec3& b) const { return ray_along(a - place, b - place); }

  Vec3 place;  ///< of Embree's origin, m
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
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
  rtcPointQuery(tree_->scene, &sphere, &context, nullptr, &question);
}

bool TriangleTree::cut(const Vec3& a, const Vec3& b) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = tree_->ray(a, b);
  rtcOccluded1(tree_->scene, &context, &ray);
  return ray.tfar < 0;
}

std::optional<TriangleTree::Hit> TriangleTree::first(const Vec3& a, const Vec3& b) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit seen{};
  seen.ray = tree_->ray(a, b);
  seen.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(tree_->scene, &context, &seen);
  if (seen.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{static_cast<Index>(seen.hit.primID), a + static_cast<Real>(seen.ray.tfar) * (b - a)};
}

void TriangleTree::all(const Vec3& a, const Vec3& b, Met met, void* query) const {
  SegmentQuestion question{{}, met, query};
  rtcInitIntersectContext(&question.context);
  question.context.filter = tell_met;
  RTCRay ray = tree_->ray(a, b);
  rtcOccluded1(tree_->scene, &question.context, &ray);
}

}  // namespace gracilis
