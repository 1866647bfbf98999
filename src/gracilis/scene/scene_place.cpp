#include <gracilis/scene/scene_place.hpp>

#include <gracilis/geometry/measures.hpp>

namespace gracilis {

static constexpr Real raster = 8;  ///< m

Vec3 place_of(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return Vec3::Zero();
  return raster * (box.center() / raster).array().round();
}

Vec3 place_of(const Scene& scene) {
  Eigen::AlignedBox3d box;
  const auto see = [&](const TriangleMesh& surface) {
    if (surface.vertex_count() > 0) box.extend(bounding_box(surface.vertices));
  };
  for (const Bone& bone : scene.bones) see(bone.surface);
  for (const Muscle& muscle : scene.muscles) see(muscle.surface);
  return place_of(box);
}

static void shift(ActionLine& line, const Vec3& by) {
  line.points.colwise() += by;
  line.centers.colwise() += by;
  for (LinePoint& point : line.path.points) {
    point.place += by;
    point.frame.pretranslate(by);
  }
  for (PlacedWrap& wrap : line.path.wraps) wrap.frame.pretranslate(by);
  for (ActionLine& head : line.heads) shift(head, by);
}

Scene shifted(Scene scene, const Vec3& by) {
  for (Bone& bone : scene.bones) bone.surface.vertices.colwise() += by;
  for (Joint& joint : scene.joints) joint.frame.pretranslate(by);
  for (MuscleBody& each : scene.muscle_bodies) each.center += by;
  for (Muscle& muscle : scene.muscles) {
    muscle.surface.vertices.colwise() += by;
    muscle.given_fibers.points.colwise() += by;
    for (Aponeurosis& each : muscle.aponeuroses) each.surface.vertices.colwise() += by;
    muscle.tracts.points.colwise() += by;
    muscle.given_surface_fibers.points.colwise() += by;
    shift(muscle.action_line, by);
  }
  return scene;
}

}  // namespace gracilis
