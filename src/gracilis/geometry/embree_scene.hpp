#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <embree3/rtcore.h>

namespace gracilis {

/// The triangles of a surface for Embree, which is in single precision: about the middle of their box, so that nothing
/// is lost where a surface lies far from its frame's origin.
class EmbreeScene {
 public:
  /// `answers`: what Embree calls for triangles near a point, where somebody asks for these; `flags` besides
  /// RTC_SCENE_FLAG_ROBUST. Precondition: at least one face, all coordinates finite.
  explicit EmbreeScene(const TriangleMesh& mesh, RTCPointQueryFunction answers = nullptr,
                       RTCSceneFlags flags = RTC_SCENE_FLAG_NONE);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  const Vec3& place() const { return place_; }  ///< of Embree's origin, m
  RTCScene get() const { return scene_; }

 private:
  Vec3 place_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

/// A segment, about Embree's origin, as a ray of the length 1 in its own unit.
RTCRay ray_along(const Vec3& a, const Vec3& b);

}  // namespace gracilis
