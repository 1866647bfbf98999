#include <gracilis/anatomy/sections/action_line.hpp>

#include <cassert>
#include <cmath>

namespace gracilis {

Vec3 point_before_end(const Points& line, Real distance, Index& after) {
  for (Eigen::Index i = line.cols() - 1; i > 0; --i) {
    const Real part = (line.col(i) - line.col(i - 1)).norm();
    after = static_cast<Index>(i);
    if (distance <= part && part > 0) return line.col(i) + distance / part * (line.col(i - 1) - line.col(i));
    distance -= part;
  }
  return line.col(0);
}

TendonLengths tendon_lengths(Real optimal_fiber, Real pennation, Real slack, Real line, Real scaled_line) {
  TendonLengths lengths;
  lengths.rest = slack + optimal_fiber * std::cos(pennation);
  lengths.scaled_rest = lengths.rest * scaled_line / line;
  lengths.scaled_tendon = lengths.scaled_rest * slack / lengths.rest;
  return lengths;
}

}  // namespace gracilis
