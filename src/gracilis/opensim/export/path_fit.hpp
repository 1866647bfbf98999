#pragma once

#include <gracilis/opensim/export/path_samples.hpp>

#include <vector>

namespace gracilis::opensim {

/// A polynomial of coordinates fitted to a muscle's lengths and moment arms.
struct PathFit {
  Function function;    ///< multivariate polynomial of order 1 or more, rad and m to m
  PathErrors held_out;  ///< of samples left out of the fit in cross-validation
  Real left_out = 0;    ///< m, the root mean square of all of these, lengths and arms together
  Real ridge = 0;       ///< that was chosen
};

struct PathFitSettings {
  int largest_order = 9;
  /// What the function is drawn to where the samples do not say: lengths and arms in other poses. Empty: nothing.
  PathSamples towards = {};
  /// What a row of these may weigh beside a row of the samples; the one is chosen that predicts left-out samples best.
  std::vector<Real> ridges = {0};
  bool consecutive_parts = false;  ///< leave out a fifth of the samples in one piece instead of every fifth
};

/// Fits polynomials of order 1, 2 ... up to the largest to lengths and arms together by least squares (dL/dq of a
/// polynomial is linear in its coefficients, too; van den Bogert et al. 2013), arms times scales, and keeps the order
/// and the ridge that predict left-out samples best: a fifth of them is left out in turn. Orders with more terms than
/// half of the numbers that are known are not tried; a higher order must be better by 1 % and a micrometer. Terms are
/// products of Legendre's polynomials over the samples' ranges until the end, where they become powers. At least two
/// samples.
PathFit fit_path(const PathSamples& samples, const PathFitSettings& settings = {});

}  // namespace gracilis::opensim
