#include <gracilis/geometry/arap_surface.hpp>
#include <gracilis/geometry/arap_volume.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/arap/arap_method.hpp>
#include <gracilis/methods/registry.hpp>

#include <member_count.hpp>
#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <random>

namespace gracilis::arap {
namespace {

struct Tube {
  TriangleMesh mesh = tube_scene().muscles[0].surface;
  std::vector<char> held = std::vector<char>(static_cast<std::size_t>(mesh.vertex_count()), 0);
  Surface surface = make();

  Surface make() {
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      held[static_cast<std::size_t>(v)] = std::abs(mesh.vertices(2, v)) > 0.07;
    return Surface(mesh, build_topology(mesh.faces, mesh.vertex_count()), held);
  }
  /// Free vertices shaken by up to `amount` m.
  Points shaken(Real amount) const {
    std::mt19937 generator(3);
    std::uniform_real_distribution<Real> uniform(-amount, amount);
    Points points = mesh.vertices;
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      if (!held[static_cast<std::size_t>(v)])
        points.col(v) += Vec3(uniform(generator), uniform(generator), uniform(generator));
    return points;
  }
};

Scene arap_scene() {
  Scene scene = tube_scene();
  scene.method.name = "arap";
  return scene;
}

std::unique_ptr<DeformationMethod> method_of_scene(const Scene& scene) {
  return make_method(scene, [](const DistanceFieldSettings&) { return tube_fields(); });
}

}  // namespace

TEST(Arap, rotations_are_those_of_a_rigid_motion) {
  const Tube tube;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.5, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  for (const Eigen::Matrix3d& found : tube.surface.best_rotations(turn * tube.mesh.vertices))
    EXPECT_LT((found - turn).norm(), 1e-12);
}

TEST(Arap, rotations_never_reflect) {
  const Tube tube;
  Points mirrored = tube.mesh.vertices;
  mirrored.row(0) *= -1;
  for (const Eigen::Matrix3d& found : tube.surface.best_rotations(mirrored)) {
    EXPECT_NEAR(found.determinant(), 1, 1e-9);
    EXPECT_LT((found * found.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-9);
  }
}

TEST(Arap, both_steps_lower_the_energy_until_the_rest_is_back) {
  const Tube tube;
  Points points = tube.shaken(0.002);
  Rotations rotations(static_cast<std::size_t>(points.cols()), Eigen::Matrix3d::Identity());
  const Real first = tube.surface.energy(points, rotations);
  Real last = first;
  for (int i = 0; i < 200; ++i) {
    rotations = tube.surface.best_rotations(points);
    const Real turned = tube.surface.energy(points, rotations);
    EXPECT_LE(turned, last * (1 + 1e-9) + 1e-20);
    tube.surface.place(rotations, points);
    last = tube.surface.energy(points, rotations);
    EXPECT_LE(last, turned * (1 + 1e-9) + 1e-20);
  }
  EXPECT_LT(last, 1e-6 * first);
}

TEST(Arap, the_global_step_ends_where_the_energy_has_no_slope) {
  const Tube tube;
  Points points = tube.shaken(0.002);
  const Rotations rotations = tube.surface.best_rotations(points);
  tube.surface.place(rotations, points);
  const Real least = tube.surface.energy(points, rotations);
  for (Index v = 0; v < tube.mesh.vertex_count(); v += 11) {
    if (tube.held[static_cast<std::size_t>(v)]) continue;
    for (int k = 0; k < 3; ++k)
      for (const Real way : {-1e-5, 1e-5}) {
        Points moved = points;
        moved(k, v) += way;
        EXPECT_GT(tube.surface.energy(moved, rotations), least);
      }
  }
}

TEST(Arap, the_multiplier_restores_the_volume_and_scaling_nearly) {
  const Tube tube;
  const Real target = enclosed_volume(tube.mesh.vertices, tube.mesh.faces);
  Points points = tube.mesh.vertices;
  for (Index v = 0; v < tube.mesh.vertex_count(); ++v)
    if (!tube.held[static_cast<std::size_t>(v)]) points(1, v) *= 0.9;
  Points scaled = points;
  const Real before = std::abs(enclosed_volume(points, tube.mesh.faces) / target - 1);
  EXPECT_GT(before, 0.05);
  restore_volume_by_multiplier(tube.surface, tube.mesh.faces, tube.held, target, points);
  EXPECT_NEAR(enclosed_volume(points, tube.mesh.faces) / target, 1, 2e-6);
  restore_volume_by_scaling(tube.mesh.faces, tube.held, target, scaled);
  EXPECT_LT(std::abs(enclosed_volume(scaled, tube.mesh.faces) / target - 1), 0.6 * before) << "held ends do not scale";
  for (Index v = 0; v < tube.mesh.vertex_count(); ++v)
    if (tube.held[static_cast<std::size_t>(v)]) {
      EXPECT_EQ(points.col(v), tube.mesh.vertices.col(v));
      EXPECT_EQ(scaled.col(v), tube.mesh.vertices.col(v));
    }
}

TEST(Arap, rigid_motion_of_all_bodies_is_followed_to_1e_10_also_as_a_predictor) {
  for (const std::string name : {"arap", "pbd"}) {
    Scene scene = arap_scene();
    scene.method = {name, {}};
    if (name == "pbd") scene.method.settings["predictor"] = std::string("arap");
    const auto method = method_of_scene(scene);
    Pose pose = flexed(scene, 0);
    for (int i = 1; i <= 10; ++i) {
      const RigidTransform motion =
          Eigen::Translation3d(0.02 * i, -0.01 * i, 0.03 * i) * Eigen::AngleAxisd(0.1 * i, Vec3(1, 2, -1).normalized());
      pose.bodies = {motion, motion};
      method->advance(pose, usual_time_step);
      const Points expected = motion * scene.muscles[0].surface.vertices;
      EXPECT_LT((frame_of(*method, pose, i).muscles[0].points - expected).colwise().norm().maxCoeff(), 1e-10)
          << name << i;
    }
  }
}

TEST(Arap, every_choice_of_volume_is_heard) {
  std::vector<Real> errors;
  for (const std::string choice : {"none", "scaling", "multiplier"}) {
    Scene scene = arap_scene();
    scene.method.settings["volume"] = choice;
    const auto method = method_of_scene(scene);
    for (int degree = 3; degree <= 45; degree += 3) method->advance(flexed(scene, radians(degree)), usual_time_step);
    const TriangleMesh& rest = scene.muscles[0].surface;
    const Points now = frame_of(*method, flexed(scene, radians(45)), 1).muscles[0].points;
    errors.push_back(std::abs(enclosed_volume(now, rest.faces) / enclosed_volume(rest.vertices, rest.faces) - 1));
  }
  EXPECT_GT(errors[0], errors[1]);
  EXPECT_GT(errors[1], errors[2]);
}

TEST(Arap, a_muscle_that_is_attached_to_nothing_stays) {
  Scene scene = arap_scene();
  scene.muscles[0].attachments.clear();
  const auto method = method_of_scene(scene);
  const Pose pose = flexed(scene, radians(10));
  method->advance(pose, usual_time_step);
  EXPECT_LT((frame_of(*method, pose, 1).muscles[0].points - scene.muscles[0].surface.vertices).norm(), 1e-9);
}

TEST(Arap, no_setting_is_forgotten) { EXPECT_EQ(setting_table<ArapSettings>().size(), member_count<ArapSettings>()); }

}  // namespace gracilis::arap
