#include <gracilis/opensim/export/legendre_terms.hpp>

#include <algorithm>
#include <map>
#include <numeric>

namespace gracilis::opensim {

static int total_of(const std::vector<int>& degrees) { return std::accumulate(degrees.begin(), degrees.end(), 0); }

LegendreTerms::LegendreTerms(const Eigen::VectorXd& least, const Eigen::VectorXd& most, int order)
    : center_((least + most) / 2),
      half_(((most - least) / 2).cwiseMax(1e-9)),
      degrees_(monomials(static_cast<int>(least.size()), order)) {
  std::stable_sort(degrees_.begin(), degrees_.end(),
                   [](const auto& a, const auto& b) { return total_of(a) < total_of(b); });
}

Eigen::Index LegendreTerms::count(int order) const {
  return std::count_if(degrees_.begin(), degrees_.end(), [&](const auto& term) { return total_of(term) <= order; });
}

/// Legendre's polynomials of x up to a degree, a column each, or their derivatives: (n + 1) P_{n+1} = (2n + 1) x P_n -
/// n P_{n-1}, and P'_{n+1} = P'_{n-1} + (2n + 1) P_n.
static Eigen::MatrixXd legendre(const Eigen::ArrayXd& x, int degree, bool derived) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Ones(x.size(), degree + 1);
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(x.size(), degree + 1);
  for (int n = 0; n < degree; ++n) {
    values.col(n + 1) = (2 * n + 1.0) / (n + 1) * x * values.col(n).array();
    slopes.col(n + 1) = (2 * n + 1.0) * values.col(n);
    if (n == 0) continue;
    values.col(n + 1) -= n / (n + 1.0) * values.col(n - 1);
    slopes.col(n + 1) += slopes.col(n - 1);
  }
  return derived ? slopes : values;
}

Eigen::MatrixXd LegendreTerms::rows(const Eigen::MatrixXd& coordinates, int by) const {
  const int order = total_of(degrees_.back());
  std::vector<Eigen::MatrixXd> factors;
  for (Eigen::Index i = 0; i < coordinates.cols(); ++i) {
    factors.push_back(legendre((coordinates.col(i).array() - center_[i]) / half_[i], order, i == by));
    if (i == by) factors.back() /= half_[i];
  }
  Eigen::MatrixXd rows(coordinates.rows(), static_cast<Eigen::Index>(degrees_.size()));
  for (std::size_t term = 0; term < degrees_.size(); ++term) {
    auto column = rows.col(static_cast<Eigen::Index>(term));
    column = factors[0].col(degrees_[term][0]);
    for (std::size_t i = 1; i < factors.size(); ++i) column.array() *= factors[i].col(degrees_[term][i]).array();
  }
  return rows;
}

/// Coefficients of Legendre's polynomial of (q - center) / half by powers of q.
static std::vector<std::vector<Real>> legendre_in_powers(Real center, Real half, int degree) {
  const auto times_x = [&](const std::vector<Real>& p) {
    std::vector<Real> product(p.size() + 1, 0);
    for (std::size_t k = 0; k < p.size(); ++k) {
      product[k + 1] += p[k] / half;
      product[k] -= p[k] * center / half;
    }
    return product;
  };
  std::vector<std::vector<Real>> polynomials = {{1}};
  for (int n = 0; n < degree; ++n) {
    std::vector<Real> next = times_x(polynomials.back());
    for (Real& c : next) c *= (2 * n + 1.0) / (n + 1);
    for (std::size_t k = 0; n > 0 && k < polynomials[static_cast<std::size_t>(n - 1)].size(); ++k)
      next[k] -= n / (n + 1.0) * polynomials[static_cast<std::size_t>(n - 1)][k];
    polynomials.push_back(std::move(next));
  }
  return polynomials;
}

Function LegendreTerms::in_powers(const Eigen::VectorXd& coefficients, int order) const {
  const auto dimension = static_cast<int>(center_.size());
  std::vector<std::vector<std::vector<Real>>> factors;
  for (Eigen::Index i = 0; i < center_.size(); ++i) factors.push_back(legendre_in_powers(center_[i], half_[i], order));
  std::map<std::vector<int>, Real> sums;
  for (Eigen::Index term = 0; term < coefficients.size(); ++term) {
    const std::vector<int>& degrees = degrees_[static_cast<std::size_t>(term)];
    std::map<std::vector<int>, Real> products = {{{}, coefficients[term]}};
    for (std::size_t i = 0; i < degrees.size(); ++i) {
      std::map<std::vector<int>, Real> longer;
      for (const auto& [powers, coefficient] : products)
        for (int k = 0; k <= degrees[i]; ++k) {
          std::vector<int> more = powers;
          more.push_back(k);
          longer[more] += coefficient * factors[i][static_cast<std::size_t>(degrees[i])][static_cast<std::size_t>(k)];
        }
      products = std::move(longer);
    }
    for (const auto& [powers, coefficient] : products) sums[powers] += coefficient;
  }
  Function function;
  function.kind = Function::Kind::multivariate;
  function.dimension = dimension;
  function.order = order;
  function.coefficients.clear();
  for (const std::vector<int>& powers : monomials(dimension, order)) function.coefficients.push_back(sums[powers]);
  return function;
}

}  // namespace gracilis::opensim
