#include <gracilis/geometry/halton.hpp>

#include <array>
#include <cassert>

namespace gracilis {

/// The number's digits in this base, mirrored at the point.
static Real mirrored_digits(Index number, Index base) {
  Real value = 0, place = 1;
  for (; number > 0; number /= base) {
    place /= static_cast<Real>(base);
    value += place * static_cast<Real>(number % base);
  }
  return value;
}

Eigen::MatrixXd halton_points(Index count, Index columns) {
  constexpr std::array<Index, 16> primes = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53};
  assert(columns <= static_cast<Index>(primes.size()));
  Eigen::MatrixXd points(count, columns);
  for (Index row = 0; row < count; ++row)
    for (Index column = 0; column < columns; ++column)
      points(row, column) = mirrored_digits(row + 1, primes[static_cast<std::size_t>(column)]);
  return points;
}

}  // namespace gracilis
