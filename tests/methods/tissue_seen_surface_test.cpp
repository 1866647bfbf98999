#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/methods/tissue/preparation.hpp>
#include <gracilis/methods/tissue/seen_surface.hpp>
#include <gracilis/methods/tissue/tissue_method.hpp>
#include <gracilis/simulate/measures.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

/// What is seen of a muscle whose triangles are larger than the cells in it.
namespace gracilis {
namespace {

const SettingValues converged = {{"tension_frames", 1}, {"minimizer_iterations", 400}, {"minimizer_residual", 1e-5}};

/// The tube of `tube_scene` with triangles 20 to 30 mm long.
Scene coarse_tube() {
  Scene scene = tube_scene();
  Muscle& muscle = scene.muscles[0];
  muscle.surface = shapes::cylinder(0.01, 0.16, 6, 8);
  muscle.surface.vertices.colwise() += Vec3(0.0255, 0, -0.08);
  for (Attachment& attachment : muscle.attachments) {
    attachment.vertices.clear();
    for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
      const Real z = muscle.surface.vertices(2, v);
      if (attachment.end == AttachmentEnd::origin ? z > 0.07 : z < -0.07) attachment.vertices.push_back(v);
    }
  }
  scene.method.name = "tissue";
  scene.method.settings = converged;
  return scene;
}

Real volume_ratio(const Scene& scene, const Frame& frame) {
  const TriangleMesh& surface = scene.muscles[0].surface;
  return enclosed_volume(frame.muscles[0].points, surface.faces) / enclosed_volume(surface.vertices, surface.faces);
}

TEST(TissueSeenSurface, a_coarse_sheet_that_is_twisted_encloses_what_the_tissue_in_it_does) {
  Scene scene = coarse_tube();
  scene.bones.clear();
  // A sheet 5 mm thick. Its flat triangles would come nearer to each other where it is twisted.
  scene.muscles[0].surface.vertices.row(0).array() -= 0.0255;
  scene.muscles[0].surface.vertices.row(0) *= 0.25;
  const auto method = make_tissue_method(scene, {});
  for (int frame = 1; frame <= 12; ++frame) {
    Pose pose;
    pose.bodies = {RigidTransform::Identity(), RigidTransform(Eigen::AngleAxisd(radians(10 * frame), Vec3::UnitZ()))};
    method->advance(pose, usual_time_step);
    EXPECT_NEAR(volume_ratio(scene, frame_of(*method, pose, frame)), 1, 0.005) << frame;
  }
}

TEST(TissueSeenSurface, a_coarse_tube_that_is_bent_around_bones_keeps_its_volume_and_its_triangles_stay_out_of_them) {
  const Scene scene = coarse_tube();
  const auto method = make_tissue_method(scene, tube_fields());
  Measurer measurer(scene);
  Points last = scene.muscles[0].surface.vertices;
  for (int frame = 1; frame <= 45; ++frame) {
    const Pose pose = flexed(scene, radians(2 * frame));
    method->advance(pose, usual_time_step);
    const Frame made = frame_of(*method, pose, frame);
    const MuscleMeasures measures = measurer.measure(made)[0];
    EXPECT_NEAR(measures.volume_ratio, 1, 0.005) << frame;
    EXPECT_LT(measures.vertex_depth_beyond_rest, 1e-4) << frame;
    EXPECT_LT(measures.midpoint_depth_beyond_rest, 5e-4) << frame;
    // The lower end moves by 3 mm; nothing jumps.
    EXPECT_LT((made.muscles[0].points - last).colwise().norm().maxCoeff(), 0.0045) << frame;
    last = made.muscles[0].points;
  }
}

TEST(TissueSeenSurface, a_blade_that_is_pressed_between_vertices_does_not_come_through_the_edges_over_it) {
  Scene scene = tube_scene();
  scene.method.name = "tissue";
  scene.method.settings = converged;
  scene.method.settings["contact_gap"] = 0.0;
  scene.method.settings["fascia_stiffness"] = 0.0;  // or the blade would take the tube with it
  scene.bodies.push_back("blade");
  const auto blade = static_cast<Index>(scene.bodies.size()) - 1;
  scene.bones = {{"blade", blade, shapes::box({0.036, 0.0008, -0.02}, {0.06, 0.0018, 0.02})}};
  const auto method = make_tissue_method(scene, {build_bone_field(scene.bones[0], scene.distance_fields)});
  Measurer measurer(scene);
  Pose pose;
  pose.bodies.assign(scene.bodies.size(), RigidTransform::Identity());
  for (int frame = 1; frame <= 10; ++frame) {
    pose.bodies[static_cast<std::size_t>(blade)].translation().x() = -0.001 * frame;
    method->advance(pose, usual_time_step);
    const MuscleMeasures measures = measurer.measure(frame_of(*method, pose, frame))[0];
    EXPECT_LT(measures.vertex_depth_beyond_rest, 1e-4) << frame;
    EXPECT_LT(measures.midpoint_depth_beyond_rest, 1e-5) << frame;
  }
}

/// The tube of `tube_scene` at rest, where planes say that another muscle begins 1 mm inside of some of its vertices.
struct PressedTube {
  Scene scene = tube_scene();
  tissue::PreparedTissue muscle;
  Points at_rest, seen;

  explicit PressedTube(const std::function<bool(const Vec3&)>& is_pressed) {
    scene.bones.clear();
    muscle = tissue::prepare_tissue(scene, scene.muscles[0], {}, {});
    at_rest = scene.muscles[0].surface.vertices;
    std::vector<tissue::ContactPlane> planes;
    for (Index v = 0; v < muscle.vertex_count; ++v)
      if (is_pressed(at_rest.col(v))) planes.push_back({v, 0, -Vec3::UnitX(), 0.001 - at_rest(0, v)});
    const std::vector<RigidTransform> bodies(scene.bodies.size(), RigidTransform::Identity());
    tissue::Surroundings around = tissue::surroundings(muscle, bodies, tissue::cell_laws(muscle, 0, 1));
    tissue::set_planes(muscle, std::move(planes), around);
    seen = tissue::seen_surface(muscle, around, {}, muscle.lattice.nodes);
  }
};

TEST(TissueSeenSurface, what_goes_back_out_of_another_muscle_takes_no_volume) {
  const auto is_pressed = [](const Vec3& p) { return p.x() > 0.028 && std::abs(p.z()) < 0.04; };
  const PressedTube tube(is_pressed);
  Real least_pushed = 1;
  for (Index v = 0; v < tube.seen.cols(); ++v)
    if (is_pressed(tube.at_rest.col(v))) least_pushed = std::min(least_pushed, tube.at_rest(0, v) - tube.seen(0, v));
  EXPECT_GT(least_pushed, 0.0007);
  const Eigen::Matrix3Xi& faces = tube.muscle.faces;
  EXPECT_NEAR(enclosed_volume(tube.seen, faces) / enclosed_volume(tube.at_rest, faces), 1, 1e-5);
}

TEST(TissueSeenSurface, a_vertex_that_lies_alone_in_another_muscle_goes_back_by_a_share_of_its_edges) {
  const Points rest = tube_scene().muscles[0].surface.vertices;
  Index nearest = 0;
  (rest.colwise() - Vec3(0.0355, 0, 0)).colwise().squaredNorm().minCoeff(&nearest);
  const PressedTube tube([&](const Vec3& p) { return p == rest.col(nearest); });
  Real longest = 0;
  for (const MeshEdge& edge : build_topology(tube.muscle.faces, rest.cols()).edges)
    if (edge.a == nearest || edge.b == nearest)
      longest = std::max(longest, (rest.col(edge.a) - rest.col(edge.b)).norm());
  const Real pushed = rest(0, nearest) - tube.seen(0, nearest);
  EXPECT_GT(pushed, std::min(0.001, longest / 4) * 0.95);
  EXPECT_LT(pushed, std::min(0.001, longest / 4) + 1e-9);
}

}  // namespace
}  // namespace gracilis
