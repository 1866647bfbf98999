#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/rbf/curvature_cost.hpp>
#include <gracilis/methods/rbf/muscle_model.hpp>
#include <gracilis/methods/rbf/rbf_method.hpp>
#include <gracilis/methods/registry.hpp>

#include <member_count.hpp>
#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gracilis::rbf {
namespace {

struct Moved {
  RadialBasis basis;
  CurvaturePoints wanted;

  explicit Moved(RadialShape shape = RadialShape::gaussian) {
    std::mt19937 generator(11);
    std::uniform_real_distribution<Real> uniform(-1, 1);
    basis.kernel = {shape, 1.7};
    basis.centers.resize(3, 10);
    basis.weights.resize(10);
    basis.reaches = Eigen::VectorXd::Constant(10, 0.9);
    for (Index i = 0; i < 10; ++i) {
      basis.centers.col(i) = Vec3(uniform(generator), uniform(generator), uniform(generator));
      basis.weights[i] = uniform(generator);
    }
    wanted.points.resize(3, 60);
    wanted.curvatures.resize(60);
    wanted.share = 0.1;
    for (Index q = 0; q < 60; ++q) {
      wanted.points.col(q) = 1.5 * Vec3(uniform(generator), uniform(generator), uniform(generator));
      wanted.curvatures[q] = field_curvature(basis, wanted.points.col(q));
    }
    for (Index i = 0; i < 10; ++i)
      basis.centers.col(i) += 0.1 * Vec3(uniform(generator), uniform(generator), uniform(generator));
  }
};

Scene rbf_scene() {
  Scene scene = tube_scene();
  scene.method.name = "rbf";
  return scene;
}

std::unique_ptr<DeformationMethod> method_of_scene(const Scene& scene) {
  return make_method(scene, [](const DistanceFieldSettings&) { return tube_fields(); });
}

Points shape_at(const Scene& scene, Real degrees_of_flexion) {
  const auto method = method_of_scene(scene);
  const Pose pose = flexed(scene, radians(degrees_of_flexion));
  method->advance(pose, usual_time_step);
  return frame_of(*method, pose, 1).muscles[0].points;
}

Real volume_error(const Scene& scene, const Points& points) {
  const TriangleMesh& rest = scene.muscles[0].surface;
  return std::abs(enclosed_volume(points, rest.faces) / enclosed_volume(rest.vertices, rest.faces) - 1);
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

}  // namespace

TEST(Rbf, the_gradient_of_the_cost_is_that_of_finite_differences) {
  for (const RadialShape shape : {RadialShape::gaussian, RadialShape::wendland_33, RadialShape::wendland_52}) {
    const Moved moved(shape);
    const Points found = curvature_cost_gradient(moved.basis, moved.wanted);
    constexpr Real h = 1e-5;
    for (Index k = 0; k < 10; ++k)
      for (int j = 0; j < 3; ++j) {
        RadialBasis after = moved.basis, before = moved.basis;
        after.centers(j, k) += h;
        before.centers(j, k) -= h;
        const Real expected = (curvature_cost(after, moved.wanted) - curvature_cost(before, moved.wanted)) / (2 * h);
        EXPECT_NEAR(found(j, k), expected, 1e-6 * (1 + std::abs(expected))) << k << j;
      }
  }
}

TEST(Rbf, the_gradient_for_gaussians_is_the_published_one_with_its_weight) {
  const Moved moved;
  const Points found = curvature_cost_gradient(moved.basis, moved.wanted);
  const Real a = 1 / (0.9 * 0.9);
  for (Index k = 0; k < 10; ++k) {
    Vec3 sum = Vec3::Zero();
    for (Index q = 0; q < 60; ++q) {
      const Vec3 from = moved.wanted.points.col(q) - moved.basis.centers.col(k);
      const Real off = field_curvature(moved.basis, moved.wanted.points.col(q)) - moved.wanted.curvatures[q];
      const Real r2 = from.squaredNorm();
      sum += 8.0 / 3 * moved.wanted.share * off * a * a * moved.basis.weights[k] * std::exp(-a * r2) *
             (2 * a * r2 - 2 - 3) * from;
    }
    EXPECT_LT((found.col(k) - sum).norm(), 1e-12 * (1 + sum.norm()));
  }
}

TEST(Rbf, the_cost_falls_with_every_step_until_the_curvature_is_back) {
  Moved moved;
  const std::vector<char> all_free(10, 1);
  Real last = curvature_cost(moved.basis, moved.wanted);
  const Real first = last;
  for (int i = 0; i < 300; ++i) {
    const Descent done = descend(moved.basis, moved.wanted, all_free, 3, 0.02);
    EXPECT_EQ(done.before, last);
    EXPECT_LE(done.after, done.before);
    EXPECT_EQ(done.after, curvature_cost(moved.basis, moved.wanted));
    last = done.after;
  }
  EXPECT_LT(last, 1e-3 * first);
}

TEST(Rbf, attached_centers_are_not_moved_by_the_cost) {
  Moved moved;
  std::vector<char> is_free(10, 1);
  is_free[3] = 0;
  const Vec3 place = moved.basis.centers.col(3), other = moved.basis.centers.col(4);
  descend(moved.basis, moved.wanted, is_free, 10, 0.02);
  EXPECT_EQ(Vec3(moved.basis.centers.col(3)), place);
  EXPECT_GT((moved.basis.centers.col(4) - other).norm(), 0.001);
}

TEST(Rbf, the_model_is_the_distance_to_the_surface_with_a_tenth_of_its_vertices) {
  const Scene scene = rbf_scene();
  const Muscle& muscle = scene.muscles[0];
  const MeshTopology topology = build_topology(muscle.surface.faces, muscle.surface.vertex_count());
  const BodyCarriers carriers = body_carriers(muscle, topology, 0.03);
  const Index centers = muscle.surface.vertex_count() / 10;
  const MuscleModel model = muscle_model(muscle, topology, carriers, centers, 1.2);
  EXPECT_EQ(model.rest.count(), centers);
  EXPECT_LT(model.levels.cwiseAbs().mean(), 0.0005);
  EXPECT_LT(value_at(model.rest, Vec3(0.0255, 0, 0)), -0.003);
  EXPECT_GT(value_at(model.rest, Vec3(0.0255, 0.02, 0)), 0.003);
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v) EXPECT_NEAR(model.bound_shares.col(v).sum(), 1, 1e-12);
}

TEST(Rbf, volume_and_bones_can_be_switched) {
  Scene scene = rbf_scene();
  const Pose pose = flexed(scene, radians(-60));
  const Points whole = shape_at(scene, -60);
  EXPECT_LT(volume_error(scene, whole), 0.001);
  EXPECT_LT(deepest(scene, whole, pose), 1e-5);
  scene.method.settings["volume"] = "none";
  const Points without_volume = shape_at(scene, -60);
  EXPECT_GT(volume_error(scene, without_volume), 0.01);
  EXPECT_LT(deepest(scene, without_volume, pose), 1e-5);
  scene.method.settings["bones"] = false;
  EXPECT_GT(deepest(scene, shape_at(scene, -60), pose), 0.001);
}

TEST(Rbf, a_shape_follows_from_the_pose_alone) {
  const Scene scene = rbf_scene();
  const auto method = method_of_scene(scene);
  for (const Real angle : {10.0, 80.0, 45.0}) method->advance(flexed(scene, radians(angle)), usual_time_step);
  EXPECT_EQ(frame_of(*method, {}, 3).muscles[0].points, shape_at(scene, 45));
}

TEST(Rbf, a_muscle_that_is_attached_to_nothing_stays) {
  Scene scene = rbf_scene();
  scene.muscles[0].attachments.clear();
  EXPECT_LT((shape_at(scene, 10) - scene.muscles[0].surface.vertices).norm(), 1e-9);
}

TEST(Rbf, no_setting_is_forgotten) { EXPECT_EQ(setting_table<RbfSettings>().size(), member_count<RbfSettings>()); }

}  // namespace gracilis::rbf
