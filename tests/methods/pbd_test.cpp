#include <gracilis/geometry/arap_surface.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/methods/pbd/constraints.hpp>
#include <gracilis/methods/pbd/pbd_method.hpp>
#include <gracilis/methods/pbd/settings.hpp>
#include <gracilis/methods/pbd/surface.hpp>
#include <gracilis/methods/registry.hpp>

#include <member_count.hpp>
#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace gracilis::pbd {
namespace {

constexpr Real step = 1e-6;  // central differences of values of order 1: errors of 1e-10

/// The gradient by finite differences of a constraint of `count` points.
template <std::size_t count>
void expect_gradient(const std::function<Evaluated<count>(const std::array<Vec3, count>&)>& constraint,
                     std::array<Vec3, count> points) {
  const Evaluated<count> found = constraint(points);
  ASSERT_TRUE(found.has_gradient);
  for (std::size_t i = 0; i < count; ++i)
    for (int k = 0; k < 3; ++k) {
      std::array<Vec3, count> before = points, after = points;
      before[i][k] -= step;
      after[i][k] += step;
      const Real slope = (constraint(after).value - constraint(before).value) / (2 * step);
      EXPECT_NEAR(found.gradient[i][k], slope, 1e-6 * std::max(Real{1}, std::abs(slope))) << "point " << i << " " << k;
    }
}

template <std::size_t count>
std::array<Vec3, count> random_points(std::mt19937& generator) {
  std::uniform_real_distribution<Real> uniform(-1, 1);
  std::array<Vec3, count> points;
  for (Vec3& p : points) p = Vec3(uniform(generator), uniform(generator), uniform(generator));
  return points;
}

Surface surface_of_tube() {
  const Muscle muscle = tube_scene().muscles[0];
  const std::vector<Index> all_free(static_cast<std::size_t>(muscle.surface.vertex_count()), -1);
  return build_surface(muscle.surface, build_topology(muscle.surface.faces, muscle.surface.vertex_count()), all_free,
                       {});
}

}  // namespace

TEST(Pbd, the_gradient_of_distance_is_that_of_finite_differences) {
  std::mt19937 generator(1);
  for (int i = 0; i < 50; ++i)
    expect_gradient<2>([](const auto& p) { return distance_constraint(p[0], p[1], 0.3); }, random_points<2>(generator));
}

TEST(Pbd, the_gradient_of_an_angle_is_that_of_finite_differences) {
  std::mt19937 generator(2);
  int asked = 0;
  for (int i = 0; i < 200; ++i) {
    const auto p = random_points<4>(generator);
    const Real angle = arccos_angle(p[0], p[1], p[2], p[3]);
    if (angle < 0.2 || angle > pi - 0.2 || (p[1] - p[0]).norm() < 0.3) continue;  // where the differences are good
    expect_gradient<4>([](const auto& q) { return angle_constraint(q[0], q[1], q[2], q[3], 1.0); }, p);
    ++asked;
  }
  EXPECT_GT(asked, 100);
}

TEST(Pbd, the_gradient_of_volume_is_that_of_finite_differences) {
  const Surface surface = surface_of_tube();
  Points points = 10 * tube_scene().muscles[0].surface.vertices, gradient, unused;
  volume_constraint(surface, points, gradient);
  for (Index v = 0; v < static_cast<Index>(points.cols()); v += 37)
    for (int k = 0; k < 3; ++k) {
      Points before = points, after = points;
      before(k, v) -= step;
      after(k, v) += step;
      const Real slope =
          (volume_constraint(surface, after, unused) - volume_constraint(surface, before, unused)) / (2 * step);
      EXPECT_NEAR(gradient(k, v), slope, 1e-8);
    }
}

TEST(Pbd, a_flat_and_a_folded_dihedral_have_an_angle_and_no_gradient) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0.5, 1, 0), across(0.5, -1, 0), onto(0.5, 1, 0);
  EXPECT_NEAR(arccos_angle(a, b, c, across), pi, 1e-12);
  EXPECT_NEAR(arccos_angle(a, b, c, onto), 0, 1e-12);
  EXPECT_FALSE(angle_constraint(a, b, c, across, 1).has_gradient);
  EXPECT_FALSE(angle_constraint(a, b, c, onto, 1).has_gradient);
  EXPECT_FALSE(angle_constraint(a, b, b, across, 1).has_gradient) << "a triangle without area";
  EXPECT_FALSE(distance_constraint(a, a, 1).has_gradient);
}

TEST(Pbd, a_projection_corrects_its_share_of_the_error_and_leaves_held_points) {
  Vec3 a(0, 0, 0), b(2, 0, 0);
  EXPECT_TRUE(project<2>(distance_constraint(a, b, 1), 0.5, {1, 1}, {&a, &b}));
  EXPECT_NEAR((b - a).norm(), 1.5, 1e-12);
  EXPECT_NEAR(a.x(), 0.25, 1e-12) << "both go as far";
  EXPECT_TRUE(project<2>(distance_constraint(a, b, 1), 1, {0, 1}, {&a, &b}));
  EXPECT_NEAR(a.x(), 0.25, 1e-12);
  EXPECT_NEAR((b - a).norm(), 1, 1e-12);
  EXPECT_FALSE(project<2>(distance_constraint(a, b, 3), 1, {0, 0}, {&a, &b}));
}

TEST(Pbd, an_angle_moves_no_vertex_farther_than_its_limit) {
  // Only b is free, and it lies nearly on the axis of the turn that it can make: eq. 1 sends it far away.
  Vec3 a(0, 0, 0), b(1, 0, 0), c(0.001, 1, 0.5), d(0.001, -1, 0.5);
  const auto constraint = angle_constraint(a, b, c, d, 3);
  Vec3 unlimited = b;
  EXPECT_TRUE(project<4>(constraint, 1, {0, 1, 0, 0}, {&a, &unlimited, &c, &d}));
  EXPECT_GT((unlimited - Vec3(1, 0, 0)).norm(), 10);
  EXPECT_TRUE(project<4>(constraint, 1, {0, 1, 0, 0}, {&a, &b, &c, &d}, 0.05));
  EXPECT_NEAR((b - Vec3(1, 0, 0)).norm(), 0.05, 1e-12);
  EXPECT_GT((b - Vec3(1, 0, 0)).dot(unlimited - Vec3(1, 0, 0)), 0) << "the same way";
}

TEST(Pbd, edges_along_the_nearest_fiber_give_way_whichever_way_it_runs) {
  EXPECT_NEAR(anisotropy(Vec3::UnitX(), Vec3::UnitX()), 0, 1e-12);
  EXPECT_NEAR(anisotropy(Vec3::UnitX(), -Vec3::UnitX()), 0, 1e-12);
  EXPECT_NEAR(anisotropy(Vec3::UnitX(), Vec3::UnitY()), 1, 1e-12);
  EXPECT_NEAR(anisotropy(Vec3::UnitX(), Vec3::Zero()), 1, 1e-12);
  const Muscle muscle = tube_scene().muscles[0];
  const std::vector<Index> all_free(static_cast<std::size_t>(muscle.surface.vertex_count()), -1);
  Points line(3, 2);
  line << 0.0255, 0.0255, 0, 0, -0.08, 0.08;
  const Surface surface = build_surface(
      muscle.surface, build_topology(muscle.surface.faces, muscle.surface.vertex_count()), all_free, join({line}));
  int along = 0, across = 0;
  for (const EdgeConstraint& edge : surface.edges.constraints) {
    const Vec3 way = (muscle.surface.vertices.col(edge.b) - muscle.surface.vertices.col(edge.a)).normalized();
    EXPECT_NEAR(edge.anisotropy, 1 - std::abs(way.z()), 1e-9);
    along += edge.anisotropy < 1e-6;
    across += edge.anisotropy > 1 - 1e-6;
  }
  EXPECT_GT(along, 100);
  EXPECT_GT(across, 100);
}

TEST(Pbd, the_volume_comes_back_in_a_few_projections) {
  const Surface surface = surface_of_tube();
  Points points = 1.02 * tube_scene().muscles[0].surface.vertices, gradient;
  EXPECT_GT(volume_constraint(surface, points, gradient), 0.05 * surface.volume);
  for (int i = 0; i < 3; ++i) project_volume(surface, 1, points);
  EXPECT_NEAR(volume_constraint(surface, points, gradient) / surface.volume, 0, 1e-6);
}

TEST(Pbd, what_a_bone_has_moved_over_goes_with_the_bone_by_fields_and_by_voxels) {
  for (const std::string collision : {"fields", "voxels"}) {
    Scene scene = tube_scene();
    scene.method = find_preset("pbd-2020")->method;
    scene.method.settings["edge_stiffness"] = 0.0;
    scene.method.settings["angle_stiffness"] = 0.0;
    scene.method.settings["volume_stiffness"] = 0.0;
    scene.method.settings["collision"] = collision;
    const auto method = make_method(scene, [](const DistanceFieldSettings&) { return tube_fields(); });
    Pose pose = flexed(scene, 0);
    const RigidTransform motion = Eigen::Translation3d(0.002, 0, 0) * RigidTransform::Identity();
    pose.bodies[1] = motion;  // 0.5 mm of it are free
    const StepReport report = method->advance(pose, usual_time_step);
    EXPECT_GT(metric(report.muscles[0].metrics, "taken_along"), 0) << collision;
    const Points points = frame_of(*method, pose, 1).muscles[0].points, rest = scene.muscles[0].surface.vertices;
    int taken = 0;
    for (Index v = 0; v < static_cast<Index>(rest.cols()); ++v) {
      const bool is_covered = std::abs(rest(2, v)) < 0.07 && rest(2, v) < -0.01 && rest(0, v) < 0.0165;
      if (!is_covered) continue;
      EXPECT_LT((points.col(v) - motion * Vec3(rest.col(v))).norm(), 1e-9) << collision;
      ++taken;
    }
    EXPECT_GT(taken, 5);
  }
}

TEST(Pbd, no_distance_field_is_asked_for_where_bones_are_voxels) {
  Scene scene = tube_scene();
  scene.method.name = "pbd";
  scene.method.settings = {{"collision", std::string("voxels")}};
  int asked = 0;
  const BoneFieldSource fields = [&](const DistanceFieldSettings&) {
    ++asked;
    return tube_fields();
  };
  make_method(scene, fields)->advance(flexed(scene, 0.02), usual_time_step);
  EXPECT_EQ(asked, 0);
  scene.muscles[0].settings["collision"] = std::string("fields");
  make_method(scene, fields);
  EXPECT_EQ(asked, 1);
}

TEST(Pbd, every_pair_of_collision_and_way_back_keeps_a_tube_out_of_bones_that_press_it) {
  Scene scene = tube_scene();
  scene.method.name = "pbd";
  std::vector<SignedDistance> bones;
  for (const Bone& bone : scene.bones) bones.emplace_back(bone.surface);
  for (const std::string collision : {"fields", "voxels"})
    for (const std::string push_back : {"normal", "entry"}) {
      scene.method.settings = {{"collision", collision}, {"push_back", push_back}};
      const auto method = make_method(scene, [](const DistanceFieldSettings&) { return tube_fields(); });
      Real contacts = 0, taken_along = 0;
      for (int degree = 1; degree <= 40; ++degree) {
        const StepReport report = method->advance(flexed(scene, radians(-degree)), usual_time_step);
        contacts += metric(report.muscles[0].metrics, "contacts");
        taken_along += metric(report.muscles[0].metrics, "taken_along");
      }
      EXPECT_GT(contacts, 0) << collision << " " << push_back;
      EXPECT_GT(taken_along, 0) << collision << " " << push_back;
      const Pose pose = flexed(scene, radians(-40));
      const Points points = frame_of(*method, pose, 1).muscles[0].points;
      int inside = 0;
      for (Index v = 0; v < static_cast<Index>(points.cols()); ++v)
        for (std::size_t b = 0; b < bones.size(); ++b)
          inside += bones[b].query(pose.bodies[b].inverse() * Vec3(points.col(v))).distance < -1e-4;
      // What one bone has carried into the other came in by no way that leads out: such vertices are caught between
      // both.
      EXPECT_LE(inside, push_back == "entry" ? points.cols() / 50 : 0) << collision << " " << push_back;
    }
}

TEST(Pbd, the_predictor_arap_leaves_a_surface_with_less_energy_where_no_bone_is) {
  Scene scene = tube_scene();
  scene.bones.clear();
  scene.method.name = "pbd";
  scene.method.settings = {{"edge_stiffness", 0.0}, {"angle_stiffness", 0.0}, {"volume_stiffness", 0.0}};
  const Muscle& muscle = scene.muscles[0];
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  const arap::Surface surface(muscle.surface, topology,
                              std::vector<char>(static_cast<std::size_t>(muscle.surface.vertex_count()), 0));
  std::array<Real, 2> energy{};
  for (const bool is_arap : {false, true}) {
    scene.method.settings["predictor"] = std::string(is_arap ? "arap" : "carried");
    const auto method = make_method(scene, [](const DistanceFieldSettings&) { return std::vector<DistanceField>(); });
    for (int degree = 1; degree <= 20; ++degree) method->advance(flexed(scene, radians(degree)), usual_time_step);
    const Points points = frame_of(*method, {}, 0).muscles[0].points;
    energy[is_arap] = surface.energy(points, surface.best_rotations(points));
  }
  EXPECT_LT(energy[1], 0.8 * energy[0]);
}

TEST(Pbd, where_bones_press_the_predictor_arap_leaves_the_volume_as_it_is) {
  Scene scene = tube_scene();
  scene.method = {"pbd", {{"predictor", std::string("arap")}}};
  const TriangleMesh& rest = scene.muscles[0].surface;
  const auto method = make_method(scene, [](const DistanceFieldSettings&) { return tube_fields(); });
  Real contacts = 0, off = 0;
  for (int degree = 1; degree <= 60; ++degree) {
    const StepReport report = method->advance(flexed(scene, radians(degree)), usual_time_step);
    contacts += metric(report.muscles[0].metrics, "contacts");
    const Points points = frame_of(*method, {}, 0).muscles[0].points;
    off = std::max(off, std::abs(enclosed_volume(points, rest.faces) / enclosed_volume(rest.vertices, rest.faces) - 1));
  }
  EXPECT_GT(contacts, 0);
  EXPECT_LT(off, 0.01);
}

TEST(Pbd, no_setting_is_forgotten) { EXPECT_EQ(setting_table<PbdSettings>().size(), member_count<PbdSettings>()); }

TEST(Pbd, the_published_preset_switches_off_what_this_project_added) {
  const PbdSettings settings = with_values(PbdSettings{}, find_preset("pbd-2020")->method.settings);
  EXPECT_EQ(settings.iterations, 3);
  EXPECT_EQ(settings.predictor, Predictor::none);
  EXPECT_EQ(settings.collision, PbdCollision::voxels);
  EXPECT_EQ(settings.push_back, PbdPushBack::entry);
  EXPECT_EQ(settings.voxels, 64);
  EXPECT_TRUE(settings.fiber_anisotropy);
  EXPECT_FALSE(settings.bone_rest_gap);
  EXPECT_EQ(settings.bone_margin, 0);
}

}  // namespace gracilis::pbd
