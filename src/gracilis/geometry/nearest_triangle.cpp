#include <gracilis/geometry/nearest_triangle.hpp>

#include <gracilis/geometry/point_triangle.hpp>

#include <embree3/rtcore.h>

namespace gracilis {

struct NearestTriangle::Tree {
  TriangleMesh mesh;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~Tree() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

struct Query {
  const TriangleMesh& mesh;
  Vec3 p;
  NearestPoint best;
};

/// Embree calls this for each triangle whose box meets the query sphere; shrinking the radius prunes the rest.
bool consider_triangle(RTCPointQueryFunctionArguments* arguments) {
  auto& query = *static_cast<Query*>(arguments->userPtr);
  const auto face = static_cast<Index>(arguments->primID);
  const Eigen::Vector3i corners = query.mesh.faces.col(face);
  const Vec3 a = query.mesh.vertices.col(corners[0]), b = query.mesh.vertices.col(corners[1]),
             c = query.mesh.vertices.col(corners[2]);
  const Vec3 barycentric = nearest_barycentric(query.p, a, b, c);
  const Vec3 point = barycentric[0] * a + barycentric[1] * b + barycentric[2] * c;
  const Real distance = (point - query.p).norm();
  // Ties go to the lower face, so that the answer does not depend on the tree.
  if (distance > query.best.distance || (distance == query.best.distance && face > query.best.face)) return false;
  query.best = {face, barycentric, point, distance};
  // The tree's boxes are rounded to float: stay a little generous.
  const float radius = static_cast<float>(distance * (1 + 1e-5) + 1e-7);
  if (radius >= arguments->query->radius) return false;
  arguments->query->radius = radius;
  return true;
}

}  // namespace

NearestTriangle::NearestTriangle(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>()) {
  tree_->mesh = mesh;
  tree_->device = rtcNewDevice(nullptr);  // any number of threads asked for here would hold for the whole program
  tree_->scene = rtcNewScene(tree_->device);
  rtcSetSceneFlags(tree_->scene, RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(tree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices =
      static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                  3 * sizeof(float), static_cast<std::size_t>(mesh.vertex_count())));
  Eigen::Map<Eigen::Matrix3Xf>(vertices, 3, mesh.vertex_count()) = mesh.vertices.cast<float>();
  auto* faces = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                               3 * sizeof(unsigned),
                                                               static_cast<std::size_t>(mesh.face_count())));
  Eigen::Map<Eigen::Matrix<unsigned, 3, Eigen::Dynamic>>(faces, 3, mesh.face_count()) = mesh.faces.cast<unsigned>();
  rtcSetGeometryPointQueryFunction(geometry, consider_triangle);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(tree_->scene, geometry);
  rtcReleaseGeometry(geometry);  // the scene keeps it
  rtcCommitScene(tree_->scene);
}

NearestTriangle::~NearestTriangle() = default;
NearestTriangle::NearestTriangle(NearestTriangle&&) noexcept = default;
NearestTriangle& NearestTriangle::operator=(NearestTriangle&&) noexcept = default;

NearestPoint NearestTriangle::query(const Vec3& p, Real reach) const {
  Query query{tree_->mesh, p, {}};
  query.best.distance = reach;
  query.best.face = std::numeric_limits<Index>::max();
  RTCPointQuery point_query;
  point_query.x = static_cast<float>(p.x());
  point_query.y = static_cast<float>(p.y());
  point_query.z = static_cast<float>(p.z());
  point_query.time = 0;
  point_query.radius = static_cast<float>(reach * (1 + 1e-5) + 1e-7);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(tree_->scene, &point_query, &context, nullptr, &query);
  if (query.best.face == std::numeric_limits<Index>::max()) return {};
  return query.best;
}

}  // namespace gracilis
