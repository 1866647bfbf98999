#include <gracilis/geometry/nearest_triangle.hpp>

#include <gracilis/geometry/point_triangle.hpp>

#include <embree3/rtcore.h>

namespace gracilis {

struct NearestTriangle::Tree {
  TriangleMesh mesh;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  RTCGeometry geometry = nullptr;
  Eigen::Map<Eigen::Matrix3Xf> corners{nullptr, 3, 0};  ///< Embree's copy of the vertices

  ~Tree() {
    if (geometry) rtcReleaseGeometry(geometry);
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

struct Query {
  const TriangleMesh& mesh;
  Vec3 p;
  const std::function<bool(Index)>* accepts;
  NearestPoint best;
};

/// Embree calls this for each triangle whose box meets the query sphere; shrinking the radius prunes the rest.
bool consider_triangle(RTCPointQueryFunctionArguments* arguments) {
  auto& query = *static_cast<Query*>(arguments->userPtr);
  const auto face = static_cast<Index>(arguments->primID);
  if (query.accepts && !(*query.accepts)(face)) return false;
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
  rtcSetSceneFlags(tree_->scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC));

  // Only then is the geometry's own quality below heeded: refitted instead of built anew.
  rtcSetSceneBuildQuality(tree_->scene, RTC_BUILD_QUALITY_LOW);

  tree_->geometry = rtcNewGeometry(tree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices =
      static_cast<float*>(rtcSetNewGeometryBuffer(tree_->geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                  3 * sizeof(float), static_cast<std::size_t>(mesh.vertex_count())));
  new (&tree_->corners) Eigen::Map<Eigen::Matrix3Xf>(vertices, 3, mesh.vertex_count());
  tree_->corners = mesh.vertices.cast<float>();
  auto* faces = static_cast<unsigned*>(rtcSetNewGeometryBuffer(tree_->geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                               RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                                               static_cast<std::size_t>(mesh.face_count())));
  Eigen::Map<Eigen::Matrix<unsigned, 3, Eigen::Dynamic>>(faces, 3, mesh.face_count()) = mesh.faces.cast<unsigned>();
  rtcSetGeometryBuildQuality(tree_->geometry, RTC_BUILD_QUALITY_REFIT);
  rtcSetGeometryPointQueryFunction(tree_->geometry, consider_triangle);
  rtcCommitGeometry(tree_->geometry);
  rtcAttachGeometry(tree_->scene, tree_->geometry);
  rtcCommitScene(tree_->scene);
}

NearestTriangle::~NearestTriangle() = default;
NearestTriangle::NearestTriangle(NearestTriangle&&) noexcept = default;
NearestTriangle& NearestTriangle::operator=(NearestTriangle&&) noexcept = default;

void NearestTriangle::refit(const Points& vertices) {
  tree_->mesh.vertices = vertices;
  tree_->corners = vertices.cast<float>();
  rtcUpdateGeometryBuffer(tree_->geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(tree_->geometry);
  rtcCommitScene(tree_->scene);
}

static NearestPoint nearest_in(RTCScene scene, Real reach, Query query) {
  query.best.distance = reach;
  query.best.face = std::numeric_limits<Index>::max();
  RTCPointQuery point_query;
  point_query.x = static_cast<float>(query.p.x());
  point_query.y = static_cast<float>(query.p.y());
  point_query.z = static_cast<float>(query.p.z());
  point_query.time = 0;
  point_query.radius = static_cast<float>(reach * (1 + 1e-5) + 1e-7);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene, &point_query, &context, nullptr, &query);
  if (query.best.face == std::numeric_limits<Index>::max()) return {};
  return query.best;
}

NearestPoint NearestTriangle::query(const Vec3& p, Real reach) const {
  return nearest_in(tree_->scene, reach, {tree_->mesh, p, nullptr, {}});
}

NearestPoint NearestTriangle::query(const Vec3& p, Real reach, const std::function<bool(Index)>& accepts) const {
  return nearest_in(tree_->scene, reach, {tree_->mesh, p, &accepts, {}});
}

}  // namespace gracilis
