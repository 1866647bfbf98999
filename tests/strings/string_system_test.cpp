#include <gracilis/strings/string_system.hpp>

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

namespace gracilis::strings {
namespace {

TEST(StringSystem, block_elimination_solves_what_a_dense_solver_does) {
  constexpr Index nodes = 7, inner = nodes - 2;
  StringSystem system(nodes);
  system.tension = 3;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * inner, 3 * inner);
  Eigen::VectorXd right(3 * inner);
  std::srand(1);
  for (Index i = 1; i <= inner; ++i) {
    const Eigen::Matrix3d a = Eigen::Matrix3d::Random();
    system.stiffness[static_cast<std::size_t>(i)] =
        2 * system.tension * Eigen::Matrix3d::Identity() + a * a.transpose();
    system.gradient[static_cast<std::size_t>(i)] = Vec3::Random();
    dense.block<3, 3>(3 * (i - 1), 3 * (i - 1)) = system.stiffness[static_cast<std::size_t>(i)];
    right.segment<3>(3 * (i - 1)) = -system.gradient[static_cast<std::size_t>(i)];
    if (i == inner) continue;
    dense.block<3, 3>(3 * (i - 1), 3 * i).diagonal().setConstant(-system.tension);
    dense.block<3, 3>(3 * i, 3 * (i - 1)).diagonal().setConstant(-system.tension);
  }
  system.solve();
  const Eigen::VectorXd expected = dense.llt().solve(right);
  for (Index i = 1; i <= inner; ++i)
    EXPECT_LT((system.solution[static_cast<std::size_t>(i)] - expected.segment<3>(3 * (i - 1))).norm(), 1e-12);
}

TEST(StringSystem, a_spring_adds_the_derivatives_of_its_energy) {
  StringSystem system(3);
  system.stiffness[1].setZero();
  const Vec3 direction = Vec3(1, 2, 2) / 3;
  const Real k = 5, stretch = -0.01, step = 1e-6;
  system.add_spring(1, k, direction, stretch);
  const auto energy = [&](const Vec3& move) { return k / 2 * std::pow(stretch + direction.dot(move), 2); };
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 along = step * Vec3::Unit(axis);
    EXPECT_NEAR(system.gradient[1][axis], (energy(along) - energy(-along)) / (2 * step), 1e-8);
    EXPECT_NEAR(system.stiffness[1](axis, axis),
                (energy(along) - 2 * energy(Vec3::Zero()) + energy(-along)) / step / step, 1e-3);
  }
}

}  // namespace
}  // namespace gracilis::strings
