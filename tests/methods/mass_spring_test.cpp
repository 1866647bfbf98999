#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/box_mesh.hpp>
#include <gracilis/methods/mass_spring/mass_spring_method.hpp>
#include <gracilis/methods/mass_spring/muscle_model.hpp>
#include <gracilis/methods/mass_spring/settings.hpp>
#include <gracilis/methods/registry.hpp>

#include <member_count.hpp>
#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis::mass_spring {
namespace {

Scene mass_spring_scene(const SettingValues& settings = {}) {
  Scene scene = tube_scene();
  scene.method = {"mass-spring", settings};
  return scene;
}

/// Two tubes side by side, the second behind the first, that swing into each other where nothing keeps them apart.
Scene two_tubes(const SettingValues& settings = {}) {
  Scene scene = mass_spring_scene(settings);
  scene.muscles.push_back(scene.muscles[0]);
  scene.muscles[1].name = "front tube";
  scene.muscles[1].surface.vertices.colwise() += Vec3(0.021, 0, 0);
  return scene;
}

std::unique_ptr<DeformationMethod> method_of_scene(const Scene& scene) {
  return make_method(scene, [](const DistanceFieldSettings&) { return tube_fields(); });
}

Points shape_at(const Scene& scene, Real degrees_of_flexion, std::size_t muscle = 0) {
  const auto method = method_of_scene(scene);
  const Pose pose = flexed(scene, radians(degrees_of_flexion));
  method->advance(pose, usual_time_step);
  return frame_of(*method, pose, 1).muscles[muscle].points;
}

Real deepest(const Scene& scene, const Points& points, const Pose& pose) {
  Real depth = 0;
  for (std::size_t b = 0; b < scene.bones.size(); ++b)
    for (Index v = 0; v < static_cast<Index>(points.cols()); ++v) {
      const Vec3 p = pose.bodies[static_cast<std::size_t>(scene.bones[b].body)].inverse() * Vec3(points.col(v));
      depth = std::max(depth, static_cast<Real>(-sample(tube_fields()[b], Eigen::Vector3f(p.cast<float>())).distance));
    }
  return depth;
}

/// The longest edge between an attached and a free vertex, over its length at rest.
Real widest_gap_at_attachments(const Scene& scene, const Points& points) {
  const Muscle& muscle = scene.muscles[0];
  std::vector<char> is_attached(static_cast<std::size_t>(muscle.surface.vertex_count()), 0);
  for (const Attachment& attachment : muscle.attachments)
    for (const Index v : attachment.vertices) is_attached[static_cast<std::size_t>(v)] = 1;
  Real widest = 0;
  for (const MeshEdge& edge : build_topology(muscle.surface.faces, muscle.surface.vertex_count()).edges) {
    if (is_attached[static_cast<std::size_t>(edge.a)] == is_attached[static_cast<std::size_t>(edge.b)]) continue;
    const Points& rest = muscle.surface.vertices;
    widest = std::max(widest,
                      (points.col(edge.a) - points.col(edge.b)).norm() / (rest.col(edge.a) - rest.col(edge.b)).norm());
  }
  return widest;
}

}  // namespace

TEST(MassSpring, the_surface_does_not_tear_at_attachments) {
  const Scene scene = mass_spring_scene();
  for (const Real angle : {20.0, 45.0, 70.0}) {
    const Points points = shape_at(scene, angle);
    EXPECT_LT(widest_gap_at_attachments(scene, points), 1.6) << angle;
    const Pose pose = flexed(scene, radians(angle));
    for (const Attachment& attachment : scene.muscles[0].attachments)
      for (const Index v : attachment.vertices) {
        const Vec3 expected =
            pose.bodies[static_cast<std::size_t>(attachment.body)] * Vec3(scene.muscles[0].surface.vertices.col(v));
        EXPECT_LT((points.col(v) - expected).norm(), 1e-9);
      }
  }
}

TEST(MassSpring, as_published_the_surface_tears_between_bones_which_holding_and_smoothing_mends) {
  // Every particle as its nearest bone: without springs the tube is two halves.
  const SettingValues torn = {{"carry_particles", "nearest-bone"},
                              {"iterations", 1},
                              {"surface_smoothing", 0},
                              {"hold_attachments", false},
                              {"bone_collision", "none"}};
  const auto longest_edge = [](const Scene& scene, const Points& points) {
    Real longest = 0;
    const TriangleMesh& rest = scene.muscles[0].surface;
    for (const MeshEdge& edge : build_topology(rest.faces, rest.vertex_count()).edges)
      longest = std::max(longest, (points.col(edge.a) - points.col(edge.b)).norm() /
                                      (rest.vertices.col(edge.a) - rest.vertices.col(edge.b)).norm());
    return longest;
  };
  const Scene published = mass_spring_scene(torn), own = mass_spring_scene();
  EXPECT_GT(longest_edge(published, shape_at(published, 45)), 2 * longest_edge(own, shape_at(own, 45)));
}

TEST(MassSpring, springs_bring_the_lengths_that_the_motion_changed_back) {
  std::vector<Real> changes;
  for (const int iterations : {1, 30, 300}) {
    const Scene scene = mass_spring_scene({{"iterations", iterations}, {"carry_particles", "nearest-bone"}});
    const auto method = method_of_scene(scene);
    const StepReport report = method->advance(flexed(scene, radians(45)), usual_time_step);
    changes.push_back(metric(report.muscles[0].metrics, "length_changes_mm"));
    EXPECT_EQ(metric(report.muscles[0].metrics, "iterations"), iterations);
    const Real particles = metric(report.muscles[0].metrics, "particles");
    EXPECT_EQ(particles, 64 * 20);
    EXPECT_GT(metric(report.muscles[0].metrics, "boundary_particles"), 0);
    EXPECT_LT(metric(report.muscles[0].metrics, "boundary_particles"), particles) << "inner fibers meet nobody";
  }
  EXPECT_LT(changes[1], 0.8 * changes[0]);
  EXPECT_LT(changes[2], changes[1]) << "what is left is the lengthened muscle's";
}

TEST(MassSpring, every_layout_gives_shapes_and_they_differ) {
  std::vector<Points> shapes;
  for (const std::string layout : {"cubic-6", "cubic-26", "delaunay", "nearest"}) {
    shapes.push_back(shape_at(mass_spring_scene({{"layout", layout}}), 30));
    EXPECT_TRUE(shapes.back().allFinite());
    for (std::size_t other = 0; other + 1 < shapes.size(); ++other)
      EXPECT_GT((shapes.back() - shapes[other]).colwise().norm().maxCoeff(), 1e-5) << layout;
  }
}

TEST(MassSpring, fields_and_spheres_keep_the_surface_out_of_bones) {
  const Pose pose = flexed(tube_scene(), radians(-60));
  const auto depth_with = [&](const std::string& bones) {
    Scene scene = mass_spring_scene({{"bone_collision", bones}});
    // With vertices enough for spheres to stand for them.
    scene.bones[0].surface = box_mesh({-0.015, -0.03, 0.005}, {0.015, 0.03, 0.1}, {8, 16, 25});
    scene.bones[1].surface = box_mesh({-0.015, -0.03, -0.1}, {0.015, 0.03, -0.005}, {8, 16, 25});
    return deepest(scene, shape_at(scene, -60), pose);
  };
  const Real without = depth_with("none");
  EXPECT_GT(without, 0.001);
  EXPECT_LT(depth_with("fields"), 1e-5);
  EXPECT_LT(depth_with("spheres"), 0.7 * without) << "spheres of particles are not the surface";
}

TEST(MassSpring, muscles_keep_out_of_each_other) {
  // In extension both shorten into the bend.
  const auto contacts = [](bool muscle_collision) {
    const Scene scene = two_tubes({{"muscle_collision", muscle_collision}, {"bone_collision", "none"}});
    const auto method = method_of_scene(scene);
    const Pose pose = flexed(scene, radians(-60));
    const StepReport report = method->advance(pose, usual_time_step);
    return metric(report.muscles[0].metrics, "contacts") + metric(report.muscles[1].metrics, "contacts");
  };
  EXPECT_GT(contacts(true), 0);
  EXPECT_EQ(contacts(false), 0);
}

TEST(MassSpring, collisions_give_the_same_bits_for_any_number_of_threads) {
  Scene scene = two_tubes({{"bone_collision", "spheres"}});
  scene.muscles.push_back(scene.muscles[0]);
  scene.muscles[2].name = "third tube";
  scene.muscles[2].surface.vertices.colwise() += Vec3(0, 0.019, 0);
  std::vector<Points> shapes;
  for (const int threads : {1, 64}) {
    const ThreadLimit limit(threads);
    const auto method = method_of_scene(scene);
    const StepReport report = method->advance(flexed(scene, radians(30)), usual_time_step);
    for (const MuscleReport& muscle : report.muscles) EXPECT_GT(metric(muscle.metrics, "contacts"), 0);
    for (const MuscleShape& shape : frame_of(*method, {}, 1).muscles) shapes.push_back(shape.points);
  }
  ASSERT_EQ(shapes.size(), 6u);
  for (std::size_t m = 0; m < 3; ++m) EXPECT_EQ(shapes[m], shapes[m + 3]);
}

TEST(MassSpring, refitting_alone_gives_the_shapes_that_rebuilding_gives) {
  const Points rebuilt = shape_at(two_tubes({{"bone_collision", "spheres"}}), 60, 1);
  const Points refitted = shape_at(two_tubes({{"bone_collision", "spheres"}, {"refit_only", true}}), 60, 1);
  EXPECT_EQ(rebuilt, refitted) << "the same pairs, in the same order";
}

TEST(MassSpring, at_rest_two_muscles_stay_though_their_spheres_overlap) {
  for (const std::string bones : {"fields", "spheres"}) {
    const Scene scene = two_tubes({{"bone_collision", bones}});
    for (std::size_t m = 0; m < 2; ++m)
      EXPECT_LT((shape_at(scene, 0, m) - scene.muscles[m].surface.vertices).colwise().norm().maxCoeff(), 1e-6) << bones;
  }
}

TEST(MassSpring, from_the_capture_a_shape_follows_from_the_pose_alone_and_from_the_last_frame_it_goes_on) {
  const auto by_way_of = [](const std::string& start, std::vector<Real> angles) {
    const Scene scene = mass_spring_scene({{"start_from", start}});
    const auto method = method_of_scene(scene);
    for (const Real angle : angles) method->advance(flexed(scene, radians(angle)), usual_time_step);
    return frame_of(*method, {}, 1).muscles[0].points;
  };
  EXPECT_EQ(by_way_of("capture", {10, 80, 45}), by_way_of("capture", {45}));
  EXPECT_NE(by_way_of("last", {10, 80, 45}), by_way_of("last", {45}));
}

TEST(MassSpring, restored_where_frames_go_on_from_the_last_it_comes_to_the_same_bits) {
  const Scene scene = mass_spring_scene({{"start_from", "last"}, {"iterations", 20}});
  const auto method = method_of_scene(scene), resumed = method_of_scene(scene);
  std::vector<Pose> poses = {flexed(scene, 0)};
  for (int i = 1; i <= 4; ++i) {
    poses.push_back(flexed(scene, radians(3 * i)));
    method->advance(poses.back(), usual_time_step);
  }
  resumed->restore(poses, {}, frame_of(*method, poses.back(), 4));
  method->advance(flexed(scene, radians(15)), usual_time_step);
  resumed->advance(flexed(scene, radians(15)), usual_time_step);
  EXPECT_EQ(frame_of(*method, {}, 5).muscles[0].points, frame_of(*resumed, {}, 5).muscles[0].points);
}

TEST(MassSpring, a_vertex_follows_the_mean_motion_of_its_nearest_particles) {
  Scene scene = mass_spring_scene({{"surface_particles", 3}, {"surface_smoothing", 0}, {"hold_attachments", false}});
  const MuscleModel model = muscle_model(scene, scene.muscles[0], tube_fields());
  const Pose pose = flexed(scene, radians(20));
  const std::vector<RigidTransform> motions = particle_motions(model, pose);
  Points particles = carried_particles(model, motions);
  for (Index p = 0; p < static_cast<Index>(particles.cols()); ++p) particles.col(p) += 1e-3 * Vec3(p % 7, p % 5, p % 3);
  const Points surface = surface_of(model, pose, motions, particles);
  ASSERT_EQ(model.bound.rows(), 3);
  for (Index v = 0; v < static_cast<Index>(surface.cols()); v += 17) {
    Vec3 place = Vec3::Zero(), shift = Vec3::Zero();
    for (Index i = 0; i < 3; ++i) {
      const Index p = model.bound(i, v);
      place += motions[static_cast<std::size_t>(p)] * Vec3(model.rest.col(v)) / 3;
      shift += 1e-3 * Vec3(p % 7, p % 5, p % 3) / 3;
    }
    EXPECT_LT((surface.col(v) - place - shift).norm(), 1e-12);
  }
}

TEST(MassSpring, fibers_run_through_the_particles_and_are_there_again_after_a_resume) {
  for (const std::string start : {"capture", "last"}) {
    Scene scene = mass_spring_scene({{"fiber_count", 9}, {"particles_per_fiber", 12}, {"start_from", start}});
    const auto method = method_of_scene(scene), resumed = method_of_scene(scene);
    const Polylines rest = frame_of(*method, flexed(scene, 0), 0).muscles[0].fibers;
    const MuscleModel model = muscle_model(scene, scene.muscles[0], tube_fields());
    ASSERT_EQ(rest.offsets, model.particles.offsets);
    EXPECT_EQ(rest.count(), 9);
    EXPECT_EQ(rest.points, model.particles.points);
    std::vector<Pose> poses = {flexed(scene, 0), flexed(scene, radians(20)), flexed(scene, radians(40))};
    method->advance(poses[1], usual_time_step);
    method->advance(poses[2], usual_time_step);
    const Frame last = frame_of(*method, poses[2], 2);
    const Polylines& fibers = last.muscles[0].fibers;
    EXPECT_EQ(fibers.offsets, rest.offsets);
    EXPECT_GT((fibers.points - rest.points).colwise().norm().maxCoeff(), 0.01);
    resumed->restore(poses, {}, last);
    EXPECT_EQ(frame_of(*resumed, poses[2], 2).muscles[0].fibers.points, fibers.points) << start;
    scene.muscles[0].fibers.count = 0;
    EXPECT_EQ(frame_of(*method_of_scene(scene), flexed(scene, 0), 0).muscles[0].fibers.count(), 0);
  }
}

TEST(MassSpring, a_muscle_without_both_ends_follows_its_bodies_and_one_without_any_stays) {
  Scene scene = mass_spring_scene();
  scene.muscles[0].attachments.resize(1);
  EXPECT_LT((shape_at(scene, 10) - scene.muscles[0].surface.vertices).norm(), 1e-9) << "the upper bone stays";
  scene.muscles[0].attachments.clear();
  EXPECT_LT((shape_at(scene, 10) - scene.muscles[0].surface.vertices).norm(), 1e-9);
}

TEST(MassSpring, only_a_limit_of_time_watches_the_clock) {
  EXPECT_FALSE(method_of_scene(mass_spring_scene())->depends_on_clock());
  EXPECT_TRUE(method_of_scene(mass_spring_scene({{"stop_milliseconds", 5.0}}))->depends_on_clock());
}

TEST(MassSpring, a_least_step_above_the_largest_is_a_problem) {
  EXPECT_TRUE(validate_method(mass_spring_scene({{"smallest_step", 0.4}})).empty());
  const std::vector<Problem> problems = validate_method(mass_spring_scene({{"smallest_step", 0.5}}));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].what, "'smallest_step' is above 'verlet_step'");
}

TEST(MassSpring, no_setting_is_forgotten) {
  EXPECT_EQ(setting_table<MassSpringSettings>().size(), member_count<MassSpringSettings>());
}

TEST(MassSpring, the_published_preset_switches_off_what_this_project_added) {
  const MassSpringSettings settings = with_values(MassSpringSettings{}, find_preset("janak-2012")->method.settings);
  EXPECT_EQ(settings.layout, SpringLayout::nearest);
  EXPECT_EQ(settings.neighbors, 18);
  EXPECT_EQ(settings.fixed_near, FixedNear::bones);
  EXPECT_EQ(settings.carry_particles, MassSpringCarry::nearest_bone);
  EXPECT_EQ(settings.damping_rule, DampingRule::fitted);
  EXPECT_EQ(settings.bone_collision, MassSpringBones::spheres);
  EXPECT_EQ(settings.smallest_step, 0.04);
  EXPECT_FALSE(settings.hold_attachments || settings.bone_rest_gap);
  EXPECT_EQ(settings.surface_smoothing, 0);
}

}  // namespace gracilis::mass_spring
