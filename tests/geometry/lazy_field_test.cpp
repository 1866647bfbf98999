#include <gracilis/geometry/field_path.hpp>
#include <gracilis/geometry/lazy_field.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace gracilis {
namespace {

const TriangleMesh& brick() {
  static const TriangleMesh mesh = shapes::box({0.1, 0.2, 0.3}, {0.13, 0.24, 0.35});
  return mesh;
}

/// Of a slab between z = -5 mm and z = 5 mm, 40 nodes a side, 1 mm apart, with its middle at the origin.
const DistanceField& slab() {
  static const DistanceField field = [] {
    DistanceField made;
    made.origin = Vec3::Constant(-0.02);
    made.cell_size = Vec3::Constant(0.001);
    made.nodes = {41, 41, 41};
    for (int k = 0; k < 41; ++k)
      for (int i = 0; i < 41 * 41; ++i) made.values.push_back(static_cast<float>(std::abs(k - 20) * 0.001 - 0.005));
    return made;
  }();
  return field;
}

}  // namespace

TEST(LazyField, near_the_surface_tells_the_distance_and_its_slope) {
  const SignedDistance exact(brick());
  const LazyField field(brick(), exact, 0.001, 0.01);
  for (const Vec3& p : {Vec3(0.1034, 0.2213, 0.3257), Vec3(0.0973, 0.2213, 0.3257), Vec3(0.1266, 0.2213, 0.3257)}) {
    const FieldSample found = field.sample(p);
    EXPECT_NEAR(found.distance, exact.query(p).distance, 1e-6) << p.transpose();
    EXPECT_NEAR(found.gradient.x(), p.x() < 0.115 ? -1 : 1, 1e-4);
    EXPECT_NEAR(found.gradient.tail<2>().norm(), 0, 1e-4);
  }
  const Vec3 under(0.1137, 0.2029, 0.3257), over(0.1137, 0.2213, 0.3534);
  EXPECT_NEAR(field.sample(under).gradient.y(), -1, 1e-4);
  EXPECT_NEAR(field.sample(under).distance, -0.0029, 1e-6);
  EXPECT_NEAR(field.sample(over).gradient.z(), 1, 1e-4);
  EXPECT_NEAR(field.sample(over).distance, 0.0034, 1e-6);
}

TEST(LazyField, is_the_trilinear_interpolant_of_exact_nodes_and_its_gradient) {
  const SignedDistance exact(brick());
  const LazyField field(brick(), exact, 0.002, 0.01);
  std::mt19937 chance(5);
  std::uniform_real_distribution<Real> share(0, 1);
  const Vec3 low = Vec3(0.09, 0.19, 0.29);
  for (int round = 0; round < 200; ++round) {
    const Vec3 p = low + Vec3(0.05 * share(chance), 0.06 * share(chance), 0.07 * share(chance));
    const FieldSample found = field.sample(p);
    if (found.gradient.isZero()) continue;
    const Vec3 cell = ((p - low) / 0.002).array().floor(), t = (p - low) / 0.002 - cell;
    Real expected = 0;
    for (int c = 0; c < 8; ++c) {
      const Vec3 corner(c & 1, (c >> 1) & 1, (c >> 2) & 1);
      const Vec3 weights = corner.cwiseProduct(t) + (Vec3::Ones() - corner).cwiseProduct(Vec3::Ones() - t);
      expected += weights.prod() * exact.query(low + 0.002 * (cell + corner)).distance;
    }
    EXPECT_NEAR(found.distance, expected, 1e-7);
    const Real step = 1e-5;
    for (int k = 0; k < 3; ++k) {
      if (t[k] * 0.002 < step || (1 - t[k]) * 0.002 < step) continue;
      const Real slope =
          (field.sample(p + step * Vec3::Unit(k)).distance - field.sample(p - step * Vec3::Unit(k)).distance) /
          (2 * step);
      EXPECT_NEAR(found.gradient[k], slope, 2e-3);
    }
  }
}

TEST(LazyField, far_away_and_outside_tells_no_more_than_the_distance) {
  const SignedDistance exact(brick());
  const LazyField field(brick(), exact, 0.001, 0.03);
  for (const Vec3& p : {Vec3(0.155, 0.22, 0.32), Vec3(0.08, 0.18, 0.28), Vec3(0.115, 0.26, 0.375),
                        Vec3(0.5, 0.22, 0.32), Vec3(-1, -1, -1)}) {
    const FieldSample found = field.sample(p);
    const Real distance = exact.query(p).distance;
    EXPECT_LE(found.distance, distance + 1e-6) << p.transpose();
    EXPECT_GT(found.distance, 0.5 * distance - 0.012) << p.transpose();
    EXPECT_TRUE(distance < 0.016 || found.gradient.isZero());
  }
  EXPECT_NEAR(field.sample({0.5, 0.22, 0.32}).distance, 0.5 - 0.16, 1e-6) << "to the grid at least";
}

TEST(BoundedField, beyond_its_grid_tells_the_way_there_and_the_least_on_its_border) {
  const BoundedField field = bounded(slab());
  EXPECT_EQ(field.border, 0) << "the slab reaches the sides";
  EXPECT_NEAR(sample_bounded(field, {0.001f, 0.002f, 0.0125f}).distance, 0.0075, 1e-7);
  EXPECT_NEAR(sample_bounded(field, {0.03f, 0, 0}).distance, 0.01, 1e-6);
  EXPECT_NEAR(sample_bounded(field, {0.023f, -0.024f, 0}).distance, 0.005, 1e-6);
  DistanceField lifted = slab();
  for (float& value : lifted.values) value += 0.012f;
  EXPECT_NEAR(bounded(lifted).border, 0.007, 1e-7) << "in the middle of the sides";
  // Each side of the grid is looked at.
  for (int axis = 0; axis < 3; ++axis)
    for (const int end : {0, 40}) {
      DistanceField field_with_dent = lifted;
      std::array<int, 3> node = {17, 23, 9};
      node[static_cast<std::size_t>(axis)] = end;
      field_with_dent.values[static_cast<std::size_t>(node[0] + 41 * (node[1] + 41 * node[2]))] = 0.001f;
      EXPECT_NEAR(bounded(field_with_dent).border, 0.001, 1e-7) << axis << ' ' << end;
    }
  EXPECT_NEAR(safe_step(slab()), 0.0005, 1e-9);
}

TEST(KeptPath, goes_straight_where_nothing_stands_in_the_way) {
  const BoundedField field = bounded(slab());
  const Eigen::Vector3f from(-0.015f, 0, 0.008f), to(0.015f, 0.004f, 0.012f);
  EXPECT_EQ(kept_path(field, from, to, 0.001f), to);
  EXPECT_EQ(kept_path(field, from, from, 0.001f), from);
  EXPECT_EQ(kept_path(field, {0, 0, 0.1f}, {0, 0, 0.2f}, 0), Eigen::Vector3f(0, 0, 0.2f)) << "outside of the grid";
}

TEST(KeptPath, slides_along_what_stands_in_the_way_and_never_comes_out_behind_it) {
  const BoundedField field = bounded(slab());
  const Eigen::Vector3f from(-0.01f, 0, 0.012f);
  const Eigen::Vector3f slid = kept_path(field, from, {0.01f, 0, -0.002f}, 0.001f);
  EXPECT_NEAR(slid.z(), 0.006, 2e-5) << "on the level of 1 mm";
  EXPECT_NEAR(slid.x(), 0.01, 1e-3);
  const Eigen::Vector3f stopped = kept_path(field, {0, 0, 0.012f}, {0, 0, -0.012f}, 0.001f);
  EXPECT_NEAR(stopped.z(), 0.006, 5e-4) << "straight through it";
  EXPECT_GT(stopped.z(), 0.005);
  const Eigen::Vector3f below = kept_path(field, {0, 0, -0.012f}, {0, 0, 0.012f}, 0.001f);
  EXPECT_NEAR(below.z(), -0.006, 5e-4);
}

}  // namespace gracilis
