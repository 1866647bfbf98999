#include <gracilis/geometry/embree_scene.hpp>

#include <gracilis/geometry/measures.hpp>

namespace gracilis {

EmbreeScene::EmbreeScene(const TriangleMesh& mesh, RTCPointQueryFunction answers, RTCSceneFlags flags)
    : place_(bounding_box(mesh.vertices).center()) {
  device_ = rtcNewDevice(nullptr);  // any number of threads asked for here would hold for the whole program
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | flags));
  const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices =
      static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                  3 * sizeof(float), static_cast<std::size_t>(mesh.vertex_count())));
  Eigen::Map<Eigen::Matrix3Xf>(vertices, 3, mesh.vertex_count()) = (mesh.vertices.colwise() - place_).cast<float>();
  auto* faces = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                               3 * sizeof(unsigned),
                                                               static_cast<std::size_t>(mesh.face_count())));
  Eigen::Map<Eigen::Matrix<unsigned, 3, Eigen::Dynamic>>(faces, 3, mesh.face_count()) = mesh.faces.cast<unsigned>();
  if (answers) rtcSetGeometryPointQueryFunction(geometry, answers);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);  // the scene keeps it
  rtcCommitScene(scene_);
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

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

}  // namespace gracilis
