#include <gracilis/methods/tissue/factored_matrix.hpp>
#include <gracilis/methods/tissue/minimize.hpp>

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace gracilis::tissue {
namespace {

/// Two points in a bent valley (Rosenbrock's function of the first two coordinates, a bowl of the third).
Real valley(const Points& x, Points& gradient) {
  Real sum = 0;
  gradient.resize(3, x.cols());
  for (Index i = 0; i < static_cast<Index>(x.cols()); ++i) {
    const Real a = x(0, i), b = x(1, i), c = x(2, i), off = b - a * a;
    sum += 100 * off * off + (1 - a) * (1 - a) + 50 * c * c;
    gradient.col(i) << -400 * a * off - 2 * (1 - a), 200 * off, 100 * c;
  }
  return sum;
}

void same(std::span<Points>) {}

TEST(TissueMinimize, finds_the_bottom_of_a_bent_valley) {
  Points x(3, 2);
  x << -1.2, 2, 1, -1, 0.3, 0.1;
  const Minimized done = minimize(valley, same, {200, 1e-9, 10}, x);
  EXPECT_LT((x.colwise() - Vec3(1, 1, 0)).norm(), 1e-8);
  EXPECT_LE(done.residual, 1e-9);
  EXPECT_LT(done.iterations, 80);
}

TEST(TissueMinimize, stops_after_its_iterations_and_at_its_residual) {
  Points x = Points::Zero(3, 2);
  EXPECT_EQ(minimize(valley, same, {3, 0, 10}, x).iterations, 3);
  Points y = Points::Zero(3, 2);
  const Minimized loose = minimize(valley, same, {200, 1, 10}, y);
  EXPECT_LE(loose.residual, 1);
  EXPECT_GT(loose.residual, 1e-6) << "it went on";
}

TEST(TissueMinimize, never_goes_where_the_energy_is_infinite_and_never_uphill) {
  Real last = std::numeric_limits<Real>::infinity();
  const auto walled = [](const Points& x, Points& gradient) {
    const Real energy = valley(x, gradient);
    return x.row(0).maxCoeff() > 0.5 ? std::numeric_limits<Real>::infinity() : energy;
  };
  Points x = Points::Zero(3, 1);
  for (int i = 0; i < 30; ++i) {
    const Minimized done = minimize(walled, same, {1, 0, 10}, x);
    EXPECT_LE(done.energy, last);
    EXPECT_LE(x(0, 0), 0.5);
    last = done.energy;
  }
  EXPECT_GT(x(0, 0), 0.3) << "it did not come near the wall";
}

TEST(TissueMinimize, a_point_moves_no_further_than_it_may_in_one_iteration) {
  Points x(3, 1);
  x << -1.2, 1, 0.3;
  const Points from = x;
  minimize(valley, same, {1, 0, 0.01}, x);
  EXPECT_LE((x - from).norm(), 0.01 * (1 + 1e-12));
  EXPECT_GT((x - from).norm(), 0);
}

TEST(TissueMinimize, a_good_metric_saves_iterations) {
  // Springs in a row whose first hangs at a wall: one step by their own stiffness, many by none.
  const Index n = 40;
  Eigen::SparseMatrix<Real> stiffness(n, n);
  for (Index i = 0; i < n; ++i) {
    stiffness.coeffRef(i, i) = i + 1 < n ? 2 : 1;
    if (i > 0) stiffness.coeffRef(i, i - 1) = stiffness.coeffRef(i - 1, i) = -1;
  }
  const Points pull = Points::Ones(3, n);
  const auto energy = [&](const Points& x, Points& gradient) {
    const Points k = (stiffness * x.transpose()).transpose();
    gradient = k - pull;
    return x.cwiseProduct(0.5 * k - pull).sum();
  };
  const FactoredMatrix factored(stiffness);
  std::array<Points, 3> solved;
  for (const std::size_t count : {1, 2, 3}) {
    std::fill(solved.begin(), solved.end(), pull);
    factored.solve(std::span(solved).first(count));
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_LT((stiffness * solved[i].transpose() - pull.transpose()).norm(), 1e-3) << "single precision";
  }
  Points x = Points::Zero(3, n), y = x;
  const Minimized with = minimize(
      energy, [&](std::span<Points> g) { factored.solve(g); }, {500, 1e-6, 1e6}, x);
  const Minimized without = minimize(energy, same, {500, 1e-6, 1e6}, y);
  EXPECT_LT(with.iterations, 6);
  EXPECT_GT(without.iterations, 20);
  EXPECT_LT((x - y).norm(), 1e-2);
}

}  // namespace
}  // namespace gracilis::tissue
