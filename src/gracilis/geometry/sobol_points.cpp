#include <gracilis/geometry/sobol_points.hpp>

#include <array>
#include <cassert>
#include <cstdint>
#include <vector>

namespace gracilis {

/// A primitive polynomial over the field of two elements, its inner coefficients as bits, and the first odd direction
/// numbers, as many as its degree.
struct SobolColumn {
  unsigned inner;
  std::vector<unsigned> first;
};

/// Joe and Kuo (2008), of the columns from the second on.
static const std::vector<SobolColumn>& sobol_columns() {
  static const std::vector<SobolColumn> columns = {{0, {1}},
                                                   {1, {1, 3}},
                                                   {1, {1, 3, 1}},
                                                   {2, {1, 1, 1}},
                                                   {1, {1, 1, 3, 3}},
                                                   {4, {1, 3, 5, 13}},
                                                   {2, {1, 1, 5, 5, 17}},
                                                   {4, {1, 1, 5, 5, 5}},
                                                   {7, {1, 1, 7, 11, 19}},
                                                   {11, {1, 1, 5, 1, 1}},
                                                   {13, {1, 1, 1, 3, 11}},
                                                   {14, {1, 3, 5, 5, 31}},
                                                   {1, {1, 3, 3, 9, 7, 49}},
                                                   {13, {1, 1, 1, 15, 21, 21}},
                                                   {16, {1, 3, 1, 13, 27, 49}},
                                                   {19, {1, 1, 1, 15, 7, 5}},
                                                   {22, {1, 3, 1, 15, 13, 25}},
                                                   {25, {1, 1, 5, 5, 19, 61}},
                                                   {1, {1, 3, 7, 11, 23, 15, 103}},
                                                   {4, {1, 3, 7, 13, 13, 15, 69}}};
  return columns;
}

static constexpr std::size_t sobol_bits = 31;
using SobolDirections = std::array<std::uint32_t, sobol_bits>;

static SobolDirections directions_of(int column) {
  SobolDirections directions{};
  if (column == 0) {
    for (std::size_t i = 0; i < sobol_bits; ++i) directions[i] = 1u << (sobol_bits - 1 - i);
    return directions;
  }
  const auto& [inner, first] = sobol_columns()[static_cast<std::size_t>(column - 1)];
  const std::size_t degree = first.size();
  for (std::size_t i = 0; i < sobol_bits; ++i) {
    if (i < degree) {
      directions[i] = first[i] << (sobol_bits - 1 - i);
      continue;
    }
    directions[i] = directions[i - degree] ^ (directions[i - degree] >> degree);
    for (std::size_t k = 1; k < degree; ++k)
      if ((inner >> (degree - 1 - k)) & 1u) directions[i] ^= directions[i - k];
  }
  return directions;
}

Eigen::MatrixXd sobol_points(Eigen::Index count, int dimensions, Eigen::Index skip) {
  assert(dimensions >= 1 && dimensions <= most_sobol_dimensions);
  Eigen::MatrixXd points(count, dimensions);
  for (int column = 0; column < dimensions; ++column) {
    const SobolDirections directions = directions_of(column);
    for (Eigen::Index row = 0; row < count; ++row) {
      std::uint32_t bits = 0;
      const auto number = static_cast<std::uint32_t>(row + skip);
      for (std::size_t i = 0; i < sobol_bits; ++i)
        if ((number >> i) & 1u) bits ^= directions[i];
      points(row, column) = static_cast<Real>(bits) / static_cast<Real>(1u << sobol_bits);
    }
  }
  return points;
}

}  // namespace gracilis
