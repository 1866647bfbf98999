#include <gracilis/calibrate/least_squares.hpp>

#include <gracilis/core/errors.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

namespace {

/// A sum of squares of which the targets' values are off by a ten-thousandth of their tolerance.
constexpr Real nothing_left = 1e-8;
constexpr Real largest_damping = 1e4;

/// The point with one number moved by `step`, away from the nearer bound where that is in the way.
Eigen::VectorXd moved(const Eigen::VectorXd& point, Index column, Real step) {
  Eigen::VectorXd result = point;
  result[column] = std::clamp<Real>(point[column] + step, 0, 1);
  return result;
}

/// Of a symmetric, positive matrix. One decomposition serves the search and the errors.
Eigen::VectorXd solved_by_directions(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(matrix);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(right.size());
  for (Index k = 0; k < right.size(); ++k) {
    const Eigen::VectorXd direction = parts.eigenvectors().col(k);
    result += direction * (direction.dot(right) / parts.eigenvalues()[k]);
  }
  return result;
}

class Search {
 public:
  Search(const ResidualFunction& residuals, const LeastSquaresOptions& options)
      : residuals_(residuals), options_(options) {}

  SearchEnd go(const Eigen::VectorXd& start) {
    place_ = start;
    const std::optional<Eigen::VectorXd> first = ask({start}).front();
    if (!first) throw QualityError("nothing can be evaluated where the search begins");
    at_ = *first;
    for (;;) {
      const Real before = objective();
      if (before < nothing_left) return end("the targets are met");
      if (!find_slopes()) return end("the number of evaluations is spent");
      if (slopes_.squaredNorm() == 0) return end("no parameter changes anything");
      const Eigen::VectorXd from = place_;
      const char* trouble = descend();
      if (trouble) return end(trouble);
      if (before - objective() <= options_.stop * before) return end("the objective changes no more");
      if ((place_ - from).cwiseAbs().maxCoeff() < options_.stop) return end("the parameters change no more");
    }
  }

 private:
  Real objective() const { return at_.squaredNorm(); }
  SearchEnd end(const std::string& why) const { return {place_, objective(), why}; }

  std::vector<std::optional<Eigen::VectorXd>> ask(const std::vector<Eigen::VectorXd>& points) {
    asked_ += static_cast<Index>(points.size());
    return residuals_(points);
  }
  bool may_ask(Index count) const { return asked_ + count <= options_.most_points; }

  bool find_slopes() {
    const Index columns = place_.size();
    if (!may_ask(columns)) return false;
    slopes_.setZero(at_.size(), columns);
    std::vector<Eigen::VectorXd> points;
    for (Index c = 0; c < columns; ++c)
      points.push_back(
          moved(place_, c, place_[c] + options_.difference <= 1 ? options_.difference : -options_.difference));
    const auto seen = ask(points);
    for (Index c = 0; c < columns; ++c) {
      const Real step = points[static_cast<std::size_t>(c)][c] - place_[c];
      if (const auto& each = seen[static_cast<std::size_t>(c)]) {
        slopes_.col(c) = (*each - at_) / step;
      } else if (const Eigen::VectorXd other = moved(place_, c, -step); other[c] != place_[c] && may_ask(1)) {
        if (const auto back = ask({other}).front()) slopes_.col(c) = (*back - at_) / (other[c] - place_[c]);
      }
    }
    return true;
  }

  /// Where a damped step of Gauss and Newton leads within the cube: what reaches a bound stays there, and the others
  /// are solved for again.
  Eigen::VectorXd step_to(Real damping) const {
    Eigen::MatrixXd normal = slopes_.transpose() * slopes_;
    const Eigen::VectorXd gradient = slopes_.transpose() * at_;
    const Real least = 1e-9 * normal.diagonal().maxCoeff();
    normal.diagonal() += damping * normal.diagonal().cwiseMax(least);
    const Index columns = place_.size();
    Eigen::VectorXd step = Eigen::VectorXd::Zero(columns);
    std::vector<Index> free;
    for (Index c = 0; c < columns; ++c) {
      const bool leads_out = (place_[c] <= 0 && gradient[c] > 0) || (place_[c] >= 1 && gradient[c] < 0);
      if (!leads_out) free.push_back(c);
    }
    while (!free.empty()) {
      const auto count = static_cast<Index>(free.size());
      Eigen::MatrixXd matrix(count, count);
      Eigen::VectorXd right(count);
      for (Index i = 0; i < count; ++i) {
        const Index row = free[static_cast<std::size_t>(i)];
        right[i] = -gradient[row];
        for (Index c = 0; c < columns; ++c) right[i] -= normal(row, c) * step[c];
        for (Index k = 0; k < count; ++k) matrix(i, k) = normal(row, free[static_cast<std::size_t>(k)]);
      }
      const Eigen::VectorXd solved = solved_by_directions(matrix, right);
      std::vector<Index> inside;
      for (Index i = 0; i < count; ++i) {
        const Index row = free[static_cast<std::size_t>(i)];
        const Real to = place_[row] + solved[i];
        if (to < 0 || to > 1)
          step[row] = (to < 0 ? 0 : 1) - place_[row];
        else
          inside.push_back(row);
      }
      if (inside.size() == free.size()) {
        for (Index i = 0; i < count; ++i) step[free[static_cast<std::size_t>(i)]] = solved[i];
        break;
      }
      free = std::move(inside);
    }
    return step;
  }

  /// One step that lowers the objective, or why there is none.
  const char* descend() {
    const Real first = std::max(damping_ / 10, Real(1e-9));
    for (Real damping = first; damping < largest_damping; damping *= 100) {
      if (!may_ask(2)) return "the number of evaluations is spent";
      const Real dampings[2] = {damping, 10 * damping};
      std::vector<Eigen::VectorXd> points;
      for (const Real each : dampings) {
        const Eigen::VectorXd step = step_to(each);
        points.push_back((place_ + step).cwiseMax(0).cwiseMin(1));
        // Where damping is low, a small promise tells that there is little to gain.
        const Real promised = objective() - (at_ + slopes_ * step).squaredNorm();
        if (damping == first && promised <= 0.1 * options_.stop * objective()) return "the objective changes no more";
        if (step.cwiseAbs().maxCoeff() < options_.stop) return "the parameters change no more";
      }
      const auto seen = ask(points);
      std::size_t better = 2;
      for (std::size_t i = 0; i < 2; ++i)
        if (seen[i] && seen[i]->squaredNorm() < (better == 2 ? objective() : seen[better]->squaredNorm())) better = i;
      if (better == 2) continue;
      place_ = points[better];
      at_ = *seen[better];
      damping_ = dampings[better];
      return nullptr;
    }
    return "no step lowers the objective";
  }

  const ResidualFunction& residuals_;
  const LeastSquaresOptions& options_;
  Eigen::VectorXd place_, at_;
  Eigen::MatrixXd slopes_;
  Real damping_ = 0.01;
  Index asked_ = 0;
};

}  // namespace

SearchEnd least_squares(const ResidualFunction& residuals, const Eigen::VectorXd& start,
                        const LeastSquaresOptions& options) {
  return Search(residuals, options).go(start);
}

Eigen::MatrixXd central_slopes(const ResidualFunction& residuals, const Eigen::VectorXd& point,
                               const Eigen::VectorXd& at, Real step) {
  std::vector<Eigen::VectorXd> points;
  for (Index c = 0; c < point.size(); ++c)
    for (const Real each : {-step, step}) points.push_back(moved(point, c, each));
  const auto seen = residuals(points);
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(at.size(), point.size());
  for (Index c = 0; c < point.size(); ++c) {
    const auto below = static_cast<std::size_t>(2 * c), above = below + 1;
    const Eigen::VectorXd& low = seen[below] ? *seen[below] : at;
    const Eigen::VectorXd& high = seen[above] ? *seen[above] : at;
    const Real width = (seen[above] ? points[above][c] : point[c]) - (seen[below] ? points[below][c] : point[c]);
    if (width > 0) slopes.col(c) = (high - low) / width;
  }
  return slopes;
}

/// Of the unit interval; what lies nearer to its ends is at a bound.
static constexpr Real at_bound = 1e-6;
/// A parameter that moves the root mean square of all residuals by less than this through all of its bounds, in
/// tolerances, says nothing.
static constexpr Real no_influence = 1e-3;
/// A standard error of as much of the bounds tells no more than the bounds.
static constexpr Real as_wide_as_bounds = 0.5;
/// Parts of a direction (of length 1) that are worth naming.
static constexpr Real large_part = 0.3;

/// Which parameters errors can be told of; the others get their remark.
static std::vector<Index> determined_ones(const Eigen::VectorXd& place, const Eigen::MatrixXd& slopes,
                                          Uncertainty& result) {
  std::vector<Index> free;
  for (Index c = 0; c < place.size(); ++c) {
    std::string& remark = result.remarks[static_cast<std::size_t>(c)];
    if (slopes.col(c).norm() < no_influence) {
      remark = "changes next to nothing that the targets tell of";
      result.errors[c] = std::numeric_limits<Real>::infinity();
    } else if (place[c] <= at_bound || place[c] >= 1 - at_bound) {
      remark = "is at its bound; the targets ask for more";
    } else {
      free.push_back(c);
    }
  }
  return free;
}

Uncertainty uncertainty_at(const Eigen::VectorXd& place, const Eigen::VectorXd& residuals,
                           const Eigen::MatrixXd& slopes) {
  const Index count = place.size();
  Uncertainty result;
  result.values = residuals.size();
  result.errors = Eigen::VectorXd::Constant(count, std::numeric_limits<Real>::quiet_NaN());
  result.correlations = Eigen::MatrixXd::Identity(count, count);
  result.remarks.resize(static_cast<std::size_t>(count));
  const std::vector<Index> free = determined_ones(place, slopes, result);
  const auto known = static_cast<Index>(free.size());
  const Index left = residuals.size() - known;
  if (free.empty() || left <= 0) {
    for (const Index c : free) result.remarks[static_cast<std::size_t>(c)] = "there are no more values than parameters";
    return result;
  }
  result.residual_variance = residuals.squaredNorm() / static_cast<Real>(left);
  Eigen::MatrixXd curvature(known, known);
  for (Index i = 0; i < known; ++i)
    for (Index k = 0; k < known; ++k)
      curvature(i, k) =
          slopes.col(free[static_cast<std::size_t>(i)]).dot(slopes.col(free[static_cast<std::size_t>(k)]));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(curvature);
  const Real largest = parts.eigenvalues()[known - 1];  // they ascend
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(known, known);
  for (Index k = 0; k < known; ++k) {
    constexpr Real rounding = 1e-13;
    const Eigen::VectorXd direction = parts.eigenvectors().col(k);
    const bool is_flat = parts.eigenvalues()[k] <= rounding * largest;
    const Real variance = result.residual_variance / std::max(parts.eigenvalues()[k], rounding * largest);
    covariance += direction * direction.transpose() * (is_flat ? std::max(variance, Real(1e6)) : variance);
    if (!is_flat && std::sqrt(variance) < as_wide_as_bounds) continue;
    std::vector<Index>& together = result.together.emplace_back();
    for (Index i = 0; i < known; ++i)
      if (std::abs(direction[i]) > large_part) together.push_back(free[static_cast<std::size_t>(i)]);
  }
  for (Index i = 0; i < known; ++i) {
    const Index row = free[static_cast<std::size_t>(i)];
    result.errors[row] = std::sqrt(covariance(i, i));
    if (result.errors[row] > as_wide_as_bounds)
      result.remarks[static_cast<std::size_t>(row)] = "is not determined by the targets within its bounds";
    for (Index k = 0; k < known; ++k)
      result.correlations(row, free[static_cast<std::size_t>(k)]) =
          covariance(i, k) / std::sqrt(covariance(i, i) * covariance(k, k));
  }
  return result;
}

}  // namespace gracilis
