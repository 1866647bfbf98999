#pragma once

#include <gracilis/calibrate/calibration.hpp>
#include <gracilis/calibrate/least_squares.hpp>

namespace gracilis {

/// The sum of squares lowered by NLopt's BOBYQA, COBYLA or SBPLX, which ask for one point after the other and for no
/// slopes. A point that cannot be evaluated counts as worse than all seen. Precondition: `method` is one of these.
/// Throws QualityError where the start cannot be evaluated.
SearchEnd direct_search(SearchMethod method, const ResidualFunction& residuals, const Eigen::VectorXd& start,
                        const LeastSquaresOptions& options);

}  // namespace gracilis
