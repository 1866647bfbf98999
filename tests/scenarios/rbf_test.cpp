#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/radial_solid.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/surface_extraction.hpp>

#include <surface_distance.hpp>

#include "scenario_runs.hpp"

/// Radial basis functions (Cervenka 2024) on the cadaver's gluteus maximus.
namespace gracilis {

TEST(Rbf2024, gluteus_maximus_by_a_tenth_of_its_vertices_is_a_closed_surface_of_its_volume) {
  SKIP_WITHOUT_DATA();
  const Scene scene = cadaver_scene("flexion", {"gluteus_maximus_r"});
  const TriangleMesh& muscle = scene.muscles[0].surface;
  RadialSolidSettings settings;
  settings.centers = muscle.vertex_count() / 10;
  const RadialSolid solid = fit_solid(muscle, settings);
  const TriangleMesh found = largest_component(extract_surface(sample(implicit_solid(solid), 0.003)));
  EXPECT_TRUE(is_closed(found.faces));
  const Real volume = enclosed_volume(muscle.vertices, muscle.faces);
  EXPECT_NEAR(enclosed_volume(found.vertices, found.faces) / volume, 1, 0.01);
  const Real hausdorff = std::max(farthest_from(muscle, found), farthest_from(found, muscle));
  RecordProperty("hausdorff_mm", std::to_string(1000 * hausdorff));
  EXPECT_LT(hausdorff, 0.006) << "at the thin ends";
}

TEST(Rbf2024, gluteus_maximus_to_60_degrees_keeps_its_volume_and_out_of_bones) {
  SKIP_WITHOUT_DATA();
  Scene scene = cadaver_scene("flexion", {"gluteus_maximus_r"});
  scene.method = {"rbf"};
  for (Muscle& muscle : scene.muscles) muscle.settings.clear();
  const auto method = make_method(
      scene, [&](const DistanceFieldSettings& settings) { return cached_bone_fields(scene, settings, {}); });
  std::vector<SignedDistance> bones;
  for (const Bone& bone : scene.bones) bones.emplace_back(bone.surface);
  const Muscle& muscle = scene.muscles[0];
  std::vector<char> is_attached(static_cast<std::size_t>(muscle.surface.vertex_count()), 0);
  for (const Attachment& attachment : muscle.attachments)
    for (const Index v : attachment.vertices) is_attached[static_cast<std::size_t>(v)] = 1;
  Frame frame;
  // Each shape follows from its pose alone, so a few tell all.
  for (const Real flexion : {20.0, 40.0, 60.0}) {
    std::vector<Real> coordinates = capture_coordinates(scene);
    coordinates[0] = radians(flexion);
    const Pose pose = pose_at(scene, coordinates);
    method->advance(pose, usual_time_step);
    method->write(frame);
    const Points& points = frame.muscles[0].points;
    EXPECT_NEAR(
        enclosed_volume(points, muscle.surface.faces) / enclosed_volume(muscle.surface.vertices, muscle.surface.faces),
        1, 0.01)
        << flexion;
    Real deepest = 0;
    for (Index v = 0; v < static_cast<Index>(points.cols()); ++v) {
      if (is_attached[static_cast<std::size_t>(v)]) continue;
      for (std::size_t b = 0; b < bones.size(); ++b) {
        const RigidTransform& body = pose.bodies[static_cast<std::size_t>(scene.bones[b].body)];
        deepest = std::max(deepest, -bones[b].query(body.inverse() * Vec3(points.col(v))).distance);
      }
    }
    EXPECT_LT(deepest, 0.001) << flexion;
  }
  EXPECT_GT((frame.muscles[0].points - muscle.surface.vertices).colwise().norm().maxCoeff(), 0.1) << "nothing moved";
}

}  // namespace gracilis
