#pragma once

#include <gracilis/core/types.hpp>

#include <vector>

namespace gracilis::opensim {

/// Samples (a row per time) without what is faster than `cutoff` (Hz): a Butterworth filter of third order run forwards
/// and backwards, so that nothing is delayed, as OpenSim's tools do. At both ends half as many rows are put before, the
/// signal turned about its first and last value. Uneven times are evened out for it and restored. Throws
/// ConfigurationError unless the cutoff lies below half the sampling rate, and InputError where two rows are so close
/// that evened out there were more than a million.
Eigen::MatrixXd low_pass(const std::vector<Real>& times, const Eigen::MatrixXd& values, Real cutoff);

}  // namespace gracilis::opensim
