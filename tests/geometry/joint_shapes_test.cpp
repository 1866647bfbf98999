#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mirrored_mesh.hpp>
#include <gracilis/geometry/revolution_fit.hpp>
#include <gracilis/geometry/sphere_fit.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {
using shapes::cylinder;
using shapes::sphere;

namespace {

const Vec3 head(0.1, -0.2, 0.3);

/// A ball on a neck: what the end of a femur is to a fit.
SurfaceSamples ball_on_a_neck() {
  TriangleMesh ball = sphere(head, 0.024, 4);
  // Below its middle the ball narrows into a neck that leads away.
  for (auto point : ball.vertices.colwise())
    if (const Real below = head.z() - 0.008 - point.z(); below > 0) point.z() -= 4 * below;
  return surface_samples(ball);
}

}  // namespace

TEST(SphereFit, the_head_of_a_ball_on_a_neck_is_found) {
  const SphereFit fit = fit_sphere(ball_on_a_neck(), 0.015, 0.035);
  EXPECT_LT((fit.center - head).norm(), 0.0003);
  EXPECT_NEAR(fit.radius, 0.024, 0.0003);
  EXPECT_GT(fit.share, 0.55);
  EXPECT_LT(fit.share, 0.8);
}

TEST(SphereFit, none_is_found_beyond_the_radii_that_may_be_or_where_it_is_not_liked) {
  EXPECT_EQ(fit_sphere(ball_on_a_neck(), 0.03, 0.04).radius, 0);
  EXPECT_EQ(fit_sphere(ball_on_a_neck(), 0.015, 0.035, [](const Vec3&, Real) { return 0.0; }).radius, 0);
  EXPECT_EQ(fit_sphere(surface_samples({Points(3, 0), Eigen::Matrix3Xi(3, 0)}), 0.01, 1).radius, 0);
}

TEST(SphereFit, tells_what_share_of_the_sphere_there_is_and_how_far_off_it_lies_at_any_size) {
  for (const Real radius : {0.02, 3.0}) {
    const SurfaceSamples ball = surface_samples(sphere(head, radius, 4));
    const SphereFit whole = fit_sphere(ball, 0.7 * radius, 1.5 * radius);
    EXPECT_NEAR(whole.share, 1, 0.01);
    EXPECT_LT((whole.center - head).norm(), 1e-3 * radius);
    EXPECT_NEAR(whole.radius / radius, 1, 1e-3);
    EXPECT_LT(whole.residual, 1e-6 * radius) << "its vertices lie on it";
    const SphereFit half =
        fit_sphere(ball.kept([&](Index i) { return ball.points(2, i) > head.z(); }), 0.7 * radius, 1.5 * radius);
    EXPECT_NEAR(half.share, 0.5, 0.03);
    EXPECT_NEAR(half.radius / radius, 1, 1e-3);
    SurfaceSamples rough = ball;
    for (Index i = 0; i < rough.count(); ++i)
      rough.points.col(i) += (i % 2 == 0 ? 0.01 : -0.01) * radius * rough.normals.col(i);
    EXPECT_NEAR(fit_sphere(rough, 0.7 * radius, 1.5 * radius).residual / radius, 0.01, 1e-3);
  }
}

TEST(RevolutionFit, half_a_spool_shows_its_axis) {
  // Thinner in the middle, as a trochlea is; about z through (0.02, 0.03).
  TriangleMesh spool = cylinder(0.012, 0.03, 40, 20);
  const Real middle = bounding_box(spool.vertices).center().z();
  for (auto point : spool.vertices.colwise()) {
    point.head<2>() *= 1 + 900 * std::pow(point.z() - middle, 2);
    point += Vec3(0.02, 0.03, 0);
  }
  const SurfaceSamples all = surface_samples(spool);
  const SurfaceSamples front = all.kept([&](Index i) {
    return all.points(0, i) > 0.02 && std::abs(all.points(2, i) - middle) < 0.0149;  // without its flat ends
  });
  const Vec3 about = Vec3(0.2, 0.3, 1).normalized();
  const RevolutionFit fit = fit_revolution(front, about, 0.02);
  EXPECT_GT(fit.direction.dot(Vec3::UnitZ()), std::cos(radians(2)));
  EXPECT_LT((fit.center - Vec3(0.02, 0.03, fit.center.z())).norm(), 0.001);
  EXPECT_LT(fit.misfit, 0.1);
}

TEST(RevolutionFit, a_sphere_which_has_every_axis_gives_the_one_expected) {
  const Vec3 expected = Vec3(1, 2, 0).normalized();
  const RevolutionFit fit = fit_revolution(surface_samples(sphere(head, 0.02, 3)), expected);
  EXPECT_GT(fit.direction.dot(expected), std::cos(radians(1)));
  EXPECT_LT((fit.center - head).norm(), 0.0005);
}

TEST(RevolutionFit, of_a_cone_is_its_axis_wherever_it_stands) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vec3(2, -1, 2) / 3).toRotationMatrix();
  TriangleMesh cone = cylinder(0.01, 0.03, 60, 20);
  for (auto point : cone.vertices.colwise()) point.head<2>() *= 1 + 20 * point.z();
  cone.vertices = ((turn * cone.vertices).colwise() + Vec3(0.4, -0.3, 0.2)).eval();
  const SurfaceSamples all = surface_samples(cone);
  const auto in_cone = [&](Index i) -> Vec3 { return turn.transpose() * (all.points.col(i) - Vec3(0.4, -0.3, 0.2)); };
  const SurfaceSamples side = all.kept([&](Index i) { return in_cone(i).z() > 0.002 && in_cone(i).z() < 0.028; });
  const RevolutionFit fit = fit_revolution(side, turn * Vec3(0.1, -0.1, 1));
  EXPECT_GT(fit.direction.dot(turn.col(2)), std::cos(radians(1))) << "its triangles lean all the same way";
  EXPECT_LT((fit.center - Vec3(0.4, -0.3, 0.2)).cross(turn.col(2)).norm(), 1e-4);
  EXPECT_LT(fit.misfit, 0.01);
  Real radius = 0;
  for (Index i = 0; i < side.count(); ++i)
    radius += (side.points.col(i) - Vec3(0.4, -0.3, 0.2)).cross(turn.col(2)).norm() * side.areas[i] / side.areas.sum();
  EXPECT_NEAR(fit.radius, radius, 1e-4) << "the mean, by area";
  EXPECT_EQ(fit_revolution(side.kept([](Index i) { return i < 11; }), Vec3::UnitZ()).radius, 0) << "too few";
}

TEST(MirroredMesh, a_closed_surface_faces_outwards_as_before) {
  const TriangleMesh ball = sphere(head, 0.02, 2);
  const TriangleMesh other = mirrored(ball, Vec3::UnitX());
  EXPECT_NEAR(enclosed_volume(other.vertices, other.faces), enclosed_volume(ball.vertices, ball.faces), 1e-12);
  EXPECT_LT((other.vertices.row(0) + ball.vertices.row(0)).cwiseAbs().maxCoeff(), 1e-15);
}

}  // namespace gracilis
