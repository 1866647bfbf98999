#include <gracilis/opensim/paths/length_by_opensim.hpp>

#include "opensim/model_texts.hpp"

#include <gtest/gtest.h>

#include <random>

/// Against numbers of OpenSim's own: computed_by_opensim_test.cpp.
namespace gracilis::opensim {

static WrapSurface wrap_cylinder(Real length = 10) {
  WrapSurface surface;
  surface.radius = 0.1;
  surface.length = length;
  return surface;
}

static Real whole(const Wrap& wrap, const Vec3& a, const Vec3& b) {
  return (wrap.first() - a).norm() + wrap.length + (b - wrap.last()).norm();
}

TEST(CylinderByOpenSim, touches_where_its_plane_cuts_the_lines_of_tangency) {
  const WrapSurface surface = wrap_cylinder();
  const Vec3 a(-0.3, 0.02, -0.1), b(0.2, 0.03, 0.25);
  const Wrap wrap = cylinder_by_opensim(surface, a, b), shortest = wrap_around(surface, a, b);
  ASSERT_EQ(wrap.kind, Wrap::Kind::needed);
  const Real share = a.head<2>().norm() / (a.head<2>().norm() + b.head<2>().norm());
  const Vec3 on_axis(0, 0, -0.1 + share * 0.35), normal = (a - on_axis).cross(b - on_axis).normalized();
  for (const bool last : {false, true}) {
    const Vec3 touch = last ? wrap.last() : wrap.first(), tangent = last ? shortest.last() : shortest.first();
    EXPECT_NEAR(normal.dot(touch - a), 0, 1e-15);
    EXPECT_NEAR((touch - tangent).head<2>().norm(), 0, 1e-15);
    EXPECT_GT(std::abs(touch.z() - tangent.z()), 1e-5);
  }
}

TEST(CylinderByOpenSim, is_as_long_as_the_shortest_across_the_axis_and_little_longer_askew) {
  const WrapSurface surface = wrap_cylinder();
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> number(-0.4, 0.4);
  int wrapped = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 a(number(random), number(random), number(random));
    Vec3 b(number(random), number(random), number(random));
    if (i % 2 == 0) b.z() = a.z();
    const Wrap wrap = cylinder_by_opensim(surface, a, b), shortest = wrap_around(surface, a, b);
    EXPECT_EQ(wrap.kind, shortest.kind);
    if (!wrap.touches()) continue;
    ++wrapped;
    const Real longer = whole(wrap, a, b) - whole(shortest, a, b);
    EXPECT_GE(longer, -1e-15);
    // Where a point all but touches, its height can be wrong by as much as the line climbs.
    const bool near = std::min(a.head<2>().norm(), b.head<2>().norm()) < 0.15;
    EXPECT_LT(longer, i % 2 == 0 ? 1e-15 : near ? 5e-3 : 1e-3) << i;
  }
  EXPECT_GT(wrapped, 100);
}

TEST(CylinderByOpenSim, of_more_than_half_a_turn_is_the_shortest) {
  WrapSurface surface = wrap_cylinder();
  surface.side_axis = 0;
  surface.side_sign = 1;
  const Vec3 a(-0.1469, -0.2747, -0.1595), b(0.0469, -0.396, 0.0623);
  const Wrap wrap = cylinder_by_opensim(surface, a, b), shortest = wrap_around(surface, a, b);
  ASSERT_GT(shortest.way.sweep, pi);
  EXPECT_EQ(whole(wrap, a, b), whole(shortest, a, b));
}

TEST(CylinderByOpenSim, beyond_the_cylinders_length_the_line_runs_straight) {
  const Vec3 a(-0.3, 0.02, -0.1), b(0.2, 0.03, 0.25);
  const Wrap wrap = cylinder_by_opensim(wrap_cylinder(), a, b);
  const Real lower = std::abs(wrap.first().z()), upper = std::abs(wrap.last().z());
  ASSERT_LT(lower, upper);
  EXPECT_TRUE(cylinder_by_opensim(wrap_cylinder(2.001 * lower), a, b).touches());
  EXPECT_FALSE(cylinder_by_opensim(wrap_cylinder(1.999 * lower), a, b).touches());
}

/// A muscle that runs around these objects on the ground.
static Model wrapped_pendulum(const std::string& objects, const std::string& wraps) {
  return model_from(
      pendulum(muscle("m", point("/ground", "0.3 0.05 -0.1") + point("/bodyset/rod", "0.05 -0.4 0.1"), "", wraps),
               set("WrapObjectSet", objects)));
}

static std::string wrap(const std::string& object) {
  return "<PathWrap name=\"" + object + "\"><wrap_object>" + object + "</wrap_object></PathWrap>";
}

TEST(LengthByOpenSim, is_that_of_the_way_without_cylinders) {
  const std::string ball = "<WrapSphere name=\"ball\"><radius>0.1</radius></WrapSphere>";
  for (const Model& model : {wrapped_pendulum("", ""), wrapped_pendulum(ball, wrap("ball"))}) {
    Skeleton skeleton(model);
    const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, -1.4);
    skeleton.place(q);
    const Path& path = model.muscles[0].path;
    EXPECT_EQ(length_by_opensim(skeleton, path, q), measure_path(skeleton, path, q).length);
  }
}

}  // namespace gracilis::opensim
