#include <gracilis/anatomy/sections/tendon_lengths.hpp>

#include <cmath>

namespace gracilis {

TendonLengths tendon_lengths(Real optimal_fiber, Real pennation, Real slack, Real line, Real scaled_line) {
  TendonLengths lengths;
  lengths.rest = slack + optimal_fiber * std::cos(pennation);
  lengths.scaled_rest = lengths.rest * scaled_line / line;
  lengths.scaled_tendon = lengths.rest > 0 ? lengths.scaled_rest * slack / lengths.rest : 0;
  return lengths;
}

}  // namespace gracilis
