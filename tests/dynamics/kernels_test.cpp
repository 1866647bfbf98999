#include <gracilis/dynamics/constraints/dihedral-inl.hpp>
#include <gracilis/dynamics/constraints/dihedral.hpp>
#include <gracilis/dynamics/constraints/distance-inl.hpp>

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace gracilis {
namespace {

namespace kernels = HWY_NAMESPACE;
using kernels::Scalar;
using KernelVector = kernels::Vector3<double>;
using Dihedral = std::array<Vec3, 4>;

KernelVector kernel_vector(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 plain(const KernelVector& v) { return {v.x, v.y, v.z}; }

struct AngleAndGradient {
  Real angle;
  std::array<Vec3, 4> gradient;
  Real valid;
};

AngleAndGradient answer(const kernels::DihedralAngle<double>& dihedral) {
  return {
      dihedral.angle, {plain(dihedral.g0), plain(dihedral.g1), plain(dihedral.g2), plain(dihedral.g3)}, dihedral.valid};
}

AngleAndGradient by_atan2(const Dihedral& x) {
  return answer(kernels::dihedral_angle<Scalar>(kernel_vector(x[0]), kernel_vector(x[1]), kernel_vector(x[2]),
                                                kernel_vector(x[3])));
}

AngleAndGradient by_arccos(const Dihedral& x) {
  return answer(kernels::dihedral_angle_arccos<Scalar>(kernel_vector(x[0]), kernel_vector(x[1]), kernel_vector(x[2]),
                                                       kernel_vector(x[3])));
}

/// Two triangles over an edge of length `edge` along x, with heights and feet as given, folded by `angle`: the left one
/// lies in the plane z = 0, the right one leaves it, downwards for a ridge (positive). Turned and moved, so that no
/// coordinate is special.
Dihedral folded(Real angle, Real edge, Real height2, Real height3, Real foot2, Real foot3) {
  Dihedral x = {Vec3::Zero(), Vec3(edge, 0, 0), Vec3(foot2 * edge, height2, 0),
                Vec3(foot3 * edge, -height3 * std::cos(angle), -height3 * std::sin(angle))};
  const RigidTransform somewhere =
      Eigen::Translation3d(edge * Vec3(5, -3, 7)) * Eigen::AngleAxisd(0.8, Vec3(1, -2, 0.5).normalized());
  for (Vec3& p : x) p = somewhere * p;
  return x;
}

Real angle_between(Real a, Real b) { return std::abs(std::remainder(a - b, 2 * pi)); }

Real signed_angle(const Dihedral& x) { return dihedral_angle(x[0], x[1], x[2], x[3]); }

/// Central differences of the angle over steps much shorter than the triangles' smallest feature.
std::array<Vec3, 4> differences(Dihedral x, Real step) {
  std::array<Vec3, 4> result;
  for (std::size_t k = 0; k < 4; ++k)
    for (int axis = 0; axis < 3; ++axis) {
      const Real there = x[k][axis];
      x[k][axis] = there + step;
      const Real above = signed_angle(x);
      x[k][axis] = there - step;
      const Real below = signed_angle(x);
      x[k][axis] = there;
      result[k][axis] = std::remainder(above - below, 2 * pi) / (2 * step);
    }
  return result;
}

Real largest(const std::array<Vec3, 4>& gradient) {
  Real norm = 0;
  for (const Vec3& g : gradient) norm = std::max(norm, g.norm());
  return norm;
}

struct DihedralCase {
  const char* name;
  Real angle, edge, height2, height3, foot2, foot3;
};

const DihedralCase dihedral_cases[] = {
    {"open", 0.7, 0.004, 0.003, 0.0035, 0.4, 0.6},
    {"folded the other way", -2.1, 0.004, 0.003, 0.0035, 0.4, 0.6},
    {"flat", 0, 0.004, 0.003, 0.0035, 0.4, 0.6},
    {"nearly flat", 1e-9, 0.004, 0.003, 0.0035, 0.4, 0.6},
    {"right angle", pi / 2, 0.004, 0.003, 0.003, 0.5, 0.5},
    {"nearly folded up", pi - 1e-6, 0.004, 0.003, 0.0035, 0.4, 0.6},
    {"nearly folded up the other way", -pi + 1e-6, 0.004, 0.003, 0.0035, 0.4, 0.6},
    {"folded up", pi, 0.004, 0.003, 0.0035, 0.4, 0.6},
    {"one needle along the edge", 0.5, 0.004, 4e-6, 0.003, 0.4, 0.6},
    {"two needles along the edge", -0.5, 0.004, 4e-6, 4e-6, 0.4, 0.6},
    {"needles across a tiny edge", 1.1, 1e-6, 0.003, 0.003, 0.4, 0.6},
    {"everything tiny", 1.1, 1e-6, 1e-6, 1e-6, 0.4, 0.6},
    {"apexes far beyond the ends", 0.9, 0.001, 0.002, 0.003, -5, 7},
    {"metres instead of millimetres", -0.3, 2, 1.5, 1, 0.2, 0.9},
};

Dihedral dihedral_of(const DihedralCase& c) { return folded(c.angle, c.edge, c.height2, c.height3, c.foot2, c.foot3); }

}  // namespace

TEST(EdgeLengthKernel, gradient_is_the_unit_direction_that_finite_differences_find) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<Real> uniform(-0.1, 0.1);
  for (int i = 0; i < 100; ++i) {
    Vec3 a(uniform(generator), uniform(generator), uniform(generator));
    const Vec3 b(uniform(generator), uniform(generator), uniform(generator));
    const auto edge = kernels::edge_length<Scalar>(kernel_vector(a), kernel_vector(b));
    EXPECT_NEAR(edge.length, (b - a).norm(), 1e-15);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step = 1e-6 * Vec3::Unit(axis);
      const Real difference = ((b + step - a).norm() - (b - step - a).norm()) / 2e-6;
      EXPECT_NEAR(plain(edge.direction)[axis], difference, 1e-7);
    }
  }
}

TEST(EdgeLengthKernel, an_edge_without_length_has_no_direction) {
  const KernelVector p{0.1, 0.2, 0.3};
  const auto edge = kernels::edge_length<Scalar>(p, p);
  EXPECT_EQ(edge.length, 0);
  EXPECT_EQ(plain(edge.direction).norm(), 0);
}

TEST(Atan2Kernel, agrees_with_the_library_in_all_quadrants) {
  Real worst = 0;
  for (int i = 0; i <= 20000; ++i) {
    const Real angle = -pi + 2 * pi * i / 20000;
    for (Real radius : {1e-9, 1.0, 1e6}) {
      const Real y = radius * std::sin(angle), x = radius * std::cos(angle);
      worst = std::max(worst, std::abs(kernels::atan2<Scalar>(y, x) - std::atan2(y, x)));
    }
  }
  EXPECT_LT(worst, 3e-8);
  EXPECT_GT(worst, 1e-12) << "the library was compared with itself";
}

TEST(Atan2Kernel, is_right_on_the_axes_and_zero_for_the_zero_vector) {
  EXPECT_EQ(kernels::atan2<Scalar>(0.0, 0.0), 0);
  EXPECT_EQ(kernels::atan2<Scalar>(0.0, 2.0), 0);
  EXPECT_NEAR(kernels::atan2<Scalar>(2.0, 0.0), pi / 2, 1e-12);
  EXPECT_NEAR(kernels::atan2<Scalar>(-2.0, 0.0), -pi / 2, 1e-12);
  EXPECT_NEAR(kernels::atan2<Scalar>(0.0, -2.0), pi, 1e-12);
}

TEST(DihedralKernel, recovers_the_angle_a_dihedral_was_folded_by) {
  for (const DihedralCase& c : dihedral_cases) {
    const AngleAndGradient dihedral = by_atan2(dihedral_of(c));
    EXPECT_EQ(dihedral.valid, 1) << c.name;
    EXPECT_LT(angle_between(dihedral.angle, c.angle), 5e-8) << c.name;
  }
}

TEST(DihedralKernel, gradient_agrees_with_finite_differences_even_where_dihedrals_nearly_degenerate) {
  for (const DihedralCase& c : dihedral_cases) {
    const Dihedral x = dihedral_of(c);
    const Real smallest = std::min({c.edge, c.height2, c.height3});
    const AngleAndGradient dihedral = by_atan2(x);
    const std::array<Vec3, 4> expected = differences(x, 3e-5 * smallest);
    ASSERT_GT(largest(expected), 0.1) << c.name;
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_LT((dihedral.gradient[k] - expected[k]).norm(), 2e-6 * largest(expected)) << c.name << ", particle " << k;
  }
}

TEST(DihedralKernel, gradient_pulls_no_dihedral_as_a_whole_and_turns_none) {
  for (const DihedralCase& c : dihedral_cases) {
    const Dihedral x = dihedral_of(c);
    const AngleAndGradient dihedral = by_atan2(x);
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      force += dihedral.gradient[k];
      torque += (x[k] - x[0]).cross(dihedral.gradient[k]);
    }
    const Real extent = std::max({c.edge, c.height2, c.height3}) * 10;
    EXPECT_LT(force.norm(), 1e-9 * largest(dihedral.gradient)) << c.name;
    EXPECT_LT(torque.norm(), 1e-9 * extent * largest(dihedral.gradient)) << c.name;
  }
}

TEST(DihedralKernel, a_degenerate_dihedral_is_invalid_and_has_no_gradient) {
  const Vec3 a(0.01, 0.02, 0.03), b(0.014, 0.02, 0.03), c(0.012, 0.024, 0.03), d(0.012, 0.017, 0.031);
  const Dihedral degenerate[] = {{a, a, c, d},
                                 {a, b, a, d},
                                 {a, b, c, b},
                                 {a, b, Vec3((a + b) / 2), d},
                                 {a, b, Vec3(a + 3 * (b - a)), d},
                                 {a, b, c, Vec3((a + b) / 2 + Vec3(0, 1e-8, 0))},
                                 {a, a, a, a}};
  for (const Dihedral& x : degenerate)
    for (const AngleAndGradient& dihedral : {by_atan2(x), by_arccos(x)}) {
      EXPECT_EQ(dihedral.valid, 0);
      EXPECT_EQ(dihedral.angle, 0);
      EXPECT_EQ(largest(dihedral.gradient), 0);
    }
  EXPECT_EQ(by_atan2({a, b, c, d}).valid, 1) << "what the others were made from is a good one";
}

TEST(ArccosDihedralKernel, is_the_angle_without_its_sign_with_the_gradient_of_that) {
  for (Real angle : {0.7, -0.7, 2.5, -2.5, 0.01, -0.01}) {
    const Dihedral x = folded(angle, 0.004, 0.003, 0.0035, 0.4, 0.6);
    const AngleAndGradient dihedral = by_arccos(x);
    EXPECT_EQ(dihedral.valid, 1);
    EXPECT_NEAR(dihedral.angle, std::abs(angle), 5e-8);
    const std::array<Vec3, 4> expected = differences(x, 1e-7);
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_LT((dihedral.gradient[k] - std::copysign(1, angle) * expected[k]).norm(), 1e-6 * largest(expected));
  }
}

TEST(ArccosDihedralKernel, skips_dihedrals_that_are_nearly_flat_or_folded_up) {
  for (Real angle : {0.0, 1e-4, -1e-4, pi - 1e-4, -pi + 1e-4}) {
    const AngleAndGradient dihedral = by_arccos(folded(angle, 0.004, 0.003, 0.0035, 0.4, 0.6));
    EXPECT_EQ(dihedral.valid, 0) << angle;
    EXPECT_EQ(largest(dihedral.gradient), 0) << angle;
  }
}

}  // namespace gracilis
