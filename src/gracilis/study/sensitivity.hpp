#pragma once

#include <gracilis/study/study.hpp>

#include <vector>

namespace gracilis {

/// How much an outcome depends on one parameter.
struct Sensitivity {
  Real first = 0;   ///< morris: mean of absolute elementary effects; indices: of first order; else rank correlation
  Real second = 0;  ///< morris: their standard deviation; indices: total; else nan
  int count = 0;    ///< effects, rows or runs that it was computed from
};

/// Per parameter, by what the study's sampling allows: elementary effects per unit of the range (Morris 1991;
/// Campolongo 2007), shares of the variance (first order: Saltelli et al. 2010, total: Jansen 1999), or Spearman's rank
/// correlation with the parameter where its values are numbers. nan where too few runs have the outcome.
std::vector<Sensitivity> sensitivities(const Study& study, const std::vector<Real>& values);

}  // namespace gracilis
