#include <gracilis/calibrate/direct_search.hpp>
#include <gracilis/calibrate/least_squares.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace gracilis {

namespace {

/// a exp(-b x) at twenty places, less what it is for a = 0.7, b = 0.3 (of ten times the unit interval).
Eigen::VectorXd decay(const Eigen::VectorXd& place) {
  Eigen::VectorXd values(20);
  for (Index i = 0; i < 20; ++i) {
    const Real x = 0.1 * static_cast<Real>(i);
    values[i] = 10 * (place[0] * std::exp(-10 * place[1] * x) - 0.7 * std::exp(-3 * x));
  }
  return values;
}

ResidualFunction each_of(Eigen::VectorXd (*one)(const Eigen::VectorXd&), Index& count) {
  return [one, &count](const std::vector<Eigen::VectorXd>& points) {
    std::vector<std::optional<Eigen::VectorXd>> all;
    for (const Eigen::VectorXd& point : points) {
      EXPECT_GE(point.minCoeff(), 0);
      EXPECT_LE(point.maxCoeff(), 1);
      all.emplace_back(one(point));
      ++count;
    }
    return all;
  };
}

const Eigen::VectorXd middle = Eigen::VectorXd::Constant(2, 0.5);

}  // namespace

TEST(LeastSquares, a_curve_is_fitted_in_a_few_points) {
  Index count = 0;
  const SearchEnd end = least_squares(each_of(decay, count), middle, {0.01, 1e-6, 100});
  EXPECT_NEAR(end.best[0], 0.7, 1e-4);
  EXPECT_NEAR(end.best[1], 0.3, 1e-4);
  EXPECT_LE(count, 40);
}

TEST(LeastSquares, what_lies_outside_is_approached_along_the_bound) {
  Index count = 0;
  const auto outside = [](const Eigen::VectorXd& place) {
    Eigen::VectorXd values(3);
    values << place[0] - 1.4, place[1] - 0.2, 0.5 * (place[0] + place[1]);
    return values;
  };
  const SearchEnd end = least_squares(each_of(+outside, count), middle, {0.01, 1e-6, 100});
  EXPECT_EQ(end.best[0], 1);
  EXPECT_EQ(end.best[1], 0) << "the lowest along that bound would be at -0.04";
}

TEST(LeastSquares, points_that_cannot_be_evaluated_are_gone_around) {
  Index count = 0;
  const ResidualFunction whole = each_of(decay, count);
  const ResidualFunction torn = [&](const std::vector<Eigen::VectorXd>& points) {
    auto all = whole(points);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i][0] > 0.75) all[i].reset();
    return all;
  };
  Eigen::VectorXd start(2);
  start << 0.745, 0.5;  // its difference to the right fails
  const SearchEnd end = least_squares(torn, start, {0.01, 1e-6, 200});
  EXPECT_NEAR(end.best[0], 0.7, 1e-3);
}

TEST(LeastSquares, a_start_that_cannot_be_evaluated_is_told_by_every_search) {
  const ResidualFunction none = [](const std::vector<Eigen::VectorXd>& points) {
    return std::vector<std::optional<Eigen::VectorXd>>(points.size());
  };
  EXPECT_THROW(least_squares(none, middle, {}), QualityError);
  EXPECT_THROW(direct_search(SearchMethod::bobyqa, none, middle, {}), QualityError);
}

TEST(LeastSquares, it_stops_where_nothing_changes_and_when_points_are_spent) {
  Index count = 0;
  const auto flat = [](const Eigen::VectorXd&) -> Eigen::VectorXd { return Eigen::VectorXd::Ones(3); };
  EXPECT_EQ(least_squares(each_of(+flat, count), middle, {}).stopped, "no parameter changes anything");
  count = 0;
  EXPECT_EQ(least_squares(each_of(decay, count), middle, {0.01, 1e-9, 8}).stopped,
            "the number of evaluations is spent");
  EXPECT_LE(count, 8);
}

TEST(DirectSearch, every_search_of_nlopt_comes_to_the_same_place) {
  for (const SearchMethod method : {SearchMethod::bobyqa, SearchMethod::cobyla, SearchMethod::sbplx}) {
    Index count = 0;
    const SearchEnd end = direct_search(method, each_of(decay, count), middle, {0.01, 1e-7, 2000});
    EXPECT_NEAR(end.best[0], 0.7, 0.014) << choices_of(method)[static_cast<std::size_t>(method)];
    EXPECT_NEAR(end.best[1], 0.3, 0.006) << choices_of(method)[static_cast<std::size_t>(method)];
  }
}

TEST(DirectSearch, what_the_residuals_throw_comes_out) {
  int asked = 0;
  const ResidualFunction failing = [&](const std::vector<Eigen::VectorXd>& points) {
    if (++asked > 3) throw QualityError("enough");
    return std::vector<std::optional<Eigen::VectorXd>>{decay(points[0])};
  };
  EXPECT_THROW(direct_search(SearchMethod::sbplx, failing, middle, {}), QualityError);
}

TEST(Uncertainty, standard_errors_are_those_that_repeated_measurements_scatter_by) {
  // A line through 50 values that scatter by 0.1: errors of level and slope are known in closed form.
  const Index values = 50;
  Eigen::MatrixXd slopes(values, 2);
  for (Index i = 0; i < values; ++i) slopes.row(i) << 1, static_cast<Real>(i) / values - 0.49;
  std::mt19937_64 random(3);
  std::normal_distribution<Real> normal(0, 0.1);
  Eigen::VectorXd residuals(values);
  for (Index i = 0; i < values; ++i) residuals[i] = normal(random);
  const Uncertainty found = uncertainty_at(middle, residuals, slopes);
  EXPECT_NEAR(found.errors[0], 0.1 / std::sqrt(50.0), 0.003);
  EXPECT_NEAR(found.errors[1], 0.1 / std::sqrt(slopes.col(1).squaredNorm()), 0.01);
  EXPECT_NEAR(found.correlations(0, 1), 0, 1e-9);
  EXPECT_TRUE(found.together.empty());
  EXPECT_EQ(found.remarks, std::vector<std::string>(2));
}

TEST(Uncertainty, what_is_not_determined_is_named) {
  const Eigen::VectorXd place = Eigen::VectorXd::Constant(4, 0.5), residuals = Eigen::VectorXd::Constant(10, 0.2);
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(10, 4);
  for (Index i = 0; i < 10; ++i) slopes.row(i) << 1 + 0.1 * i, 2 + 0.2 * i, i % 2, 0;  // the first two together only
  const Uncertainty found = uncertainty_at(place, residuals, slopes);
  EXPECT_GT(found.errors[0], 1);
  EXPECT_GT(found.errors[1], 1);
  EXPECT_LT(found.errors[2], 0.5);
  EXPECT_EQ(found.errors[3], std::numeric_limits<Real>::infinity());
  EXPECT_THAT(found.together, testing::ElementsAre(testing::ElementsAre(0, 1)));
  EXPECT_NE(found.remarks[0], "");
  EXPECT_EQ(found.remarks[2], "");
  EXPECT_NE(found.remarks[3], "");
}

}  // namespace gracilis
