#include <gracilis/opensim/functions/function.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

Function constant(Real value) {
  Function function;
  function.coefficients = {value};
  return function;
}

Function linear(Real slope, Real value_at_zero) {
  Function function;
  function.kind = Function::Kind::linear;
  function.coefficients = {slope, value_at_zero};
  return function;
}

/// Half the second derivatives at the knots of the cubic spline whose second differences are given: a tridiagonal
/// system, with the first and last equation as given.
static Eigen::VectorXd half_curvatures(const Eigen::VectorXd& lower, Eigen::VectorXd diagonal,
                                       const Eigen::VectorXd& upper, Eigen::VectorXd right) {
  const Eigen::Index n = diagonal.size();
  for (Eigen::Index i = 1; i < n; ++i) {
    const Real factor = lower[i] / diagonal[i - 1];
    diagonal[i] -= factor * upper[i - 1];
    right[i] -= factor * right[i - 1];
  }
  right[n - 1] /= diagonal[n - 1];
  for (Eigen::Index i = n - 1; i-- > 0;) right[i] = (right[i] - upper[i] * right[i + 1]) / diagonal[i];
  return right;
}

/// A sixth of the third derivative of the cubic through four neighboring points, from the third divided difference.
static Real third_difference(const std::vector<Real>& x, const std::vector<Real>& y, std::size_t first) {
  Real d[4];
  for (std::size_t i = 0; i < 4; ++i) d[i] = y[first + i];
  for (std::size_t step = 1; step < 4; ++step)
    for (std::size_t i = 3; i >= step; --i) d[i] = (d[i] - d[i - 1]) / (x[first + i] - x[first + i - step]);
  return d[3];
}

static Function spline(const std::vector<Real>& x, const std::vector<Real>& y, bool natural) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::VectorXd lower = Eigen::VectorXd::Zero(n), upper = lower, right = lower, diagonal = Eigen::VectorXd::Ones(n);
  const auto at = [](const std::vector<Real>& values, Eigen::Index i) { return values[static_cast<std::size_t>(i)]; };
  const auto width = [&](Eigen::Index i) { return at(x, i + 1) - at(x, i); };
  const auto slope = [&](Eigen::Index i) { return (at(y, i + 1) - at(y, i)) / width(i); };
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    lower[i] = width(i - 1);
    diagonal[i] = 2 * (width(i - 1) + width(i));
    upper[i] = width(i);
    right[i] = 3 * (slope(i) - slope(i - 1));
  }
  if (!natural && n > 2) {
    // The third derivative is constant on the outermost pieces: the difference of curvatures over the width.
    const bool four = n > 3;
    diagonal[0] = -1;
    upper[0] = 1;
    right[0] = four ? 3 * width(0) * third_difference(x, y, 0) : 0;
    lower[n - 1] = -1;
    right[n - 1] = four ? 3 * width(n - 2) * third_difference(x, y, x.size() - 4) : 0;
  }
  const Eigen::VectorXd c = half_curvatures(lower, diagonal, upper, right);
  Function function;
  function.kind = Function::Kind::spline;
  function.knots = x;
  function.pieces.resize(n, 4);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index left = std::min(i, n - 2);  // the last knot belongs to the piece before it
    const Real h = width(left), d = (c[left + 1] - c[left]) / (3 * h);
    Real b = slope(left) - h * (2 * c[left] + c[left + 1]) / 3;
    if (i == n - 1) b += h * (c[left] + c[left + 1]);
    function.pieces.row(i) << at(y, i), b, c[i], d;
  }
  return function;
}

Function simm_spline(const std::vector<Real>& x, const std::vector<Real>& y) { return spline(x, y, false); }
Function natural_spline(const std::vector<Real>& x, const std::vector<Real>& y) { return spline(x, y, true); }

Function piecewise_linear(const std::vector<Real>& x, const std::vector<Real>& y) {
  Function function;
  function.kind = Function::Kind::piecewise_linear;
  function.knots = x;
  const auto n = static_cast<Eigen::Index>(x.size());
  function.pieces.setZero(n, 4);  // two of them are zero
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto left = static_cast<std::size_t>(std::min(i, n - 2));
    function.pieces(i, 0) = y[static_cast<std::size_t>(i)];
    function.pieces(i, 1) = (y[left + 1] - y[left]) / (x[left + 1] - x[left]);
  }
  return function;
}

Function sine(Real amplitude, Real angular_frequency, Real phase, Real offset) {
  Function function;
  function.kind = Function::Kind::sine;
  function.coefficients = {amplitude, angular_frequency, phase, offset};
  return function;
}

Function product_of_sines(Real amplitude, const std::vector<Real>& phases) {
  Function function;
  function.kind = Function::Kind::product_of_sines;
  function.coefficients = {amplitude};
  function.coefficients.insert(function.coefficients.end(), phases.begin(), phases.end());
  return function;
}

std::vector<std::vector<int>> monomials(int dimension, int order) {
  std::vector<std::vector<int>> powers = {{}};
  for (int argument = 0; argument < dimension; ++argument) {
    std::vector<std::vector<int>> longer;
    for (const std::vector<int>& start : powers) {
      int left = order;
      for (const int power : start) left -= power;
      for (int power = 0; power <= left; ++power) {
        longer.push_back(start);
        longer.back().push_back(power);
      }
    }
    powers = std::move(longer);
  }
  return powers;
}

/// The n-th derivative of x^power.
static Real power_derivative(Real x, int power, int n) {
  Real factor = 1;
  for (int i = 0; i < n; ++i) factor *= power - i;
  return factor == 0 ? 0 : factor * std::pow(x, power - n);
}

static Real piecewise(const Function& function, Real x, int n) {
  const auto after = std::upper_bound(function.knots.begin(), function.knots.end(), x);
  const auto i = std::max<std::ptrdiff_t>(after - function.knots.begin() - 1, 0);
  const auto piece = function.pieces.row(i);
  const Real h = x - function.knots[static_cast<std::size_t>(i)];
  const bool beyond = h < 0 || after == function.knots.end();
  const auto terms = static_cast<int>(beyond ? piece.size() / 2 : piece.size());
  Real sum = 0;
  for (int power = terms - 1; power >= n; --power) {
    Real factor = 1;
    for (int k = 0; k < n; ++k) factor *= power - k;
    sum = sum * h + factor * piece[power];
  }
  return sum;
}

/// The n-th derivative turns a sine by n quarters.
static Real sine_derivative(const std::vector<Real>& c, Real x, int n) {
  return c[0] * std::pow(c[1], n) * std::sin(c[1] * x + c[2] + n * pi / 2) + (n == 0 ? c[3] : 0);
}

static Real sine_product(const std::vector<Real>& c, const std::vector<Real>& x, const std::vector<int>& by) {
  Real product = c[0];
  for (std::size_t i = 1; i < c.size(); ++i)
    product *= std::sin(x[i - 1] + c[i] +
                        static_cast<Real>(std::count(by.begin(), by.end(), static_cast<int>(i - 1))) * pi / 2);
  const auto known = [&](int argument) { return argument + 1 < static_cast<int>(c.size()); };
  return std::all_of(by.begin(), by.end(), known) ? product : 0;
}

/// The terms from `argument` on, whose powers together are `left` at most, in the order of the coefficients.
static Real sum_of_terms(const Function& function, const std::vector<Real>& arguments, const std::vector<int>& by,
                         int argument, int left, std::size_t& term) {
  if (argument == function.dimension) return function.coefficients[term++];
  const auto derived = static_cast<int>(std::count(by.begin(), by.end(), argument));
  Real sum = 0;
  for (int power = 0; power <= left; ++power)
    sum += power_derivative(arguments[static_cast<std::size_t>(argument)], power, derived) *
           sum_of_terms(function, arguments, by, argument + 1, left - power, term);
  return sum;
}

static Real multivariate(const Function& function, const std::vector<Real>& arguments, const std::vector<int>& by) {
  std::size_t term = 0;
  return sum_of_terms(function, arguments, by, 0, function.order, term);
}

static Real unscaled(const Function& function, const std::vector<Real>& arguments, const std::vector<int>& by) {
  const int n = static_cast<int>(by.size());
  const std::vector<Real>& c = function.coefficients;
  switch (function.kind) {
    case Function::Kind::constant:
      return n == 0 ? c[0] : 0;
    case Function::Kind::linear: {
      if (n > 0) return n == 1 && by[0] + 1 < static_cast<int>(c.size()) ? c[static_cast<std::size_t>(by[0])] : 0;
      Real sum = c.back();
      for (std::size_t i = 0; i + 1 < c.size(); ++i) sum += c[i] * arguments[i];
      return sum;
    }
    case Function::Kind::polynomial: {
      if (std::any_of(by.begin(), by.end(), [](int argument) { return argument != 0; })) return 0;
      Real sum = 0;
      for (std::size_t i = 0; i < c.size(); ++i)
        sum += c[i] * power_derivative(arguments[0], static_cast<int>(c.size() - 1 - i), n);
      return sum;
    }
    case Function::Kind::multivariate:
      return multivariate(function, arguments, by);
    case Function::Kind::spline:
    case Function::Kind::piecewise_linear:
      if (std::any_of(by.begin(), by.end(), [](int argument) { return argument != 0; })) return 0;
      return piecewise(function, arguments[0], n);
    case Function::Kind::sine:
      if (std::any_of(by.begin(), by.end(), [](int argument) { return argument != 0; })) return 0;
      return sine_derivative(c, arguments[0], n);
    case Function::Kind::product_of_sines:
      return sine_product(c, arguments, by);
  }
  return 0;
}

Real value(const Function& function, const std::vector<Real>& arguments) {
  return function.scale * unscaled(function, arguments, {});
}

Real derivative(const Function& function, const std::vector<Real>& arguments, const std::vector<int>& by) {
  return function.scale * unscaled(function, arguments, by);
}

}  // namespace gracilis::opensim
