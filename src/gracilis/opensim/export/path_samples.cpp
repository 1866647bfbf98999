#include <gracilis/opensim/export/path_samples.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

namespace gracilis::opensim {

/// Powers of every coordinate, a row per pose: 1, q, q² ... up to `order`.
static std::vector<Eigen::MatrixXd> powers_of(const Eigen::MatrixXd& coordinates, int order) {
  std::vector<Eigen::MatrixXd> powers;
  for (Eigen::Index i = 0; i < coordinates.cols(); ++i) {
    powers.push_back(Eigen::MatrixXd::Ones(coordinates.rows(), order + 1));
    for (int power = 1; power <= order; ++power)
      powers.back().col(power) = powers.back().col(power - 1).cwiseProduct(coordinates.col(i));
  }
  return powers;
}

/// The function's lengths, and for each coordinate its arms.
static std::pair<Eigen::VectorXd, Eigen::MatrixXd> lengths_and_arms(const Function& function,
                                                                    const Eigen::MatrixXd& coordinates) {
  assert(function.kind == Function::Kind::multivariate && function.dimension == coordinates.cols());
  const std::vector<Eigen::MatrixXd> powers = powers_of(coordinates, function.order);
  Eigen::VectorXd lengths = Eigen::VectorXd::Zero(coordinates.rows());
  Eigen::MatrixXd arms = Eigen::MatrixXd::Zero(coordinates.rows(), coordinates.cols());
  std::size_t number = 0;
  for (const std::vector<int>& term : monomials(function.dimension, function.order)) {
    const Real coefficient = function.scale * function.coefficients[number++];
    if (coefficient == 0) continue;
    // The derivative by one coordinate leaves the other factors as they are.
    for (std::size_t by = 0; by <= term.size(); ++by) {
      if (by > 0 && term[by - 1] == 0) continue;
      Eigen::VectorXd product = Eigen::VectorXd::Constant(coordinates.rows(), coefficient);
      for (std::size_t i = 0; i < term.size(); ++i) {
        const bool derived = i + 1 == by;
        if (derived) product *= term[i];
        product.array() *= powers[i].col(term[i] - (derived ? 1 : 0)).array();
      }
      if (by == 0)
        lengths += product;
      else
        arms.col(static_cast<Eigen::Index>(by - 1)) -= product;
    }
  }
  return {lengths, arms};
}

PathErrors path_errors(const Function& function, const PathSamples& samples) {
  PathErrors errors;
  if (samples.lengths.size() == 0) return errors;
  const auto [lengths, arms] = lengths_and_arms(function, samples.coordinates);
  const Eigen::VectorXd off = lengths - samples.lengths;
  errors.length_root_mean_square = std::sqrt(off.squaredNorm() / static_cast<Real>(off.size()));
  errors.length_largest = off.lpNorm<Eigen::Infinity>();
  if (samples.arms.size() == 0) return errors;
  Eigen::MatrixXd arms_off = arms - samples.arms;
  for (Eigen::Index i = 0; i < arms_off.cols(); ++i) arms_off.col(i) *= samples.scale(i);
  errors.arm_root_mean_square = std::sqrt(arms_off.squaredNorm() / static_cast<Real>(arms_off.size()));
  errors.arm_largest = arms_off.cwiseAbs().maxCoeff();
  return errors;
}

Eigen::VectorXd arm_errors(const Function& function, const PathSamples& samples) {
  if (samples.arms.size() == 0) return {};
  const Eigen::MatrixXd off = lengths_and_arms(function, samples.coordinates).second - samples.arms;
  return (off.colwise().squaredNorm() / static_cast<Real>(off.rows())).cwiseSqrt().transpose();
}

Function sum_of(const Function& a, const Function& b) {
  assert(a.dimension == b.dimension);
  Function sum = a.order >= b.order ? a : b;
  const Function& other = a.order >= b.order ? b : a;
  std::map<std::vector<int>, Real> added;
  std::size_t number = 0;
  for (const std::vector<int>& term : monomials(other.dimension, other.order))
    added[term] = other.scale * other.coefficients[number++];
  number = 0;
  for (const std::vector<int>& term : monomials(sum.dimension, sum.order)) {
    Real& coefficient = sum.coefficients[number++];
    coefficient *= sum.scale;
    if (const auto found = added.find(term); found != added.end()) coefficient += found->second;
  }
  sum.scale = 1;
  return sum;
}

}  // namespace gracilis::opensim
