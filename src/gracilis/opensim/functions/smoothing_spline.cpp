#include <gracilis/opensim/functions/smoothing_spline.hpp>

#include <SimTKmath.h>

#include <algorithm>
#include <cassert>

namespace gracilis::opensim {

/// What Woltring's program is asked for: the smoothing is given (and 0), found by generalized cross-validation, or
/// found for a known variance.
enum SplineMode { given_smoothing = 1, cross_validation = 2, known_variance = 3 };

static SimTK::Vector vector_of(const std::vector<Real>& values) {
  return {static_cast<int>(values.size()), values.data()};
}

Function smoothing_spline(const std::vector<Real>& x, const std::vector<Real>& y,
                          const SmoothingSplineSettings& settings) {
  const int n = static_cast<int>(x.size()), degree = 2 * settings.half_order - 1;
  assert(n > degree && n <= 1000 && settings.half_order >= 1 && settings.half_order <= 4 && x.size() == y.size());
  const Real variance = settings.error_variance;
  const SplineMode mode = variance == 0 ? given_smoothing : variance < 0 ? cross_validation : known_variance;
  const SimTK::Vector places = vector_of(x),
                      weights = settings.weights.empty() ? SimTK::Vector(n, 1.0) : vector_of(settings.weights);
  SimTK::Vector coefficients(n), workspace(6 * (n * settings.half_order + 1) + n);
  int problem = 0;  // is thrown
  SimTK::GCVSPLUtil::gcvspl(places, vector_of(y), weights, 1, degree, mode, std::max(variance, 0.0), coefficients,
                            workspace, problem);

  Function function;
  function.kind = Function::Kind::spline;
  function.knots = x;
  function.pieces.setZero(n, degree + 1);
  for (int i = 0; i < n; ++i) {
    // Beyond the last knot there are no higher derivatives.
    const int derivatives = i + 1 < n ? degree + 1 : settings.half_order;
    Real factorial = 1;
    for (int k = 0; k < derivatives; ++k) {
      if (k > 0) factorial *= k;
      function.pieces(i, k) =
          SimTK::GCVSPLUtil::splder(k, degree, x[static_cast<std::size_t>(i)], places, coefficients) / factorial;
    }
  }
  return function;
}

}  // namespace gracilis::opensim
