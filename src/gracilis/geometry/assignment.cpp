#include <gracilis/geometry/assignment.hpp>

#include <limits>

namespace gracilis {

std::vector<Index> cheapest_assignment(const Eigen::MatrixXd& costs) {
  const auto n = static_cast<std::size_t>(costs.rows());
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  // Column 0 is a place outside of the matrix from which each new row starts its search.
  std::vector<Real> row_potential(n + 1, 0), column_potential(n + 1, 0);
  std::vector<std::size_t> row_of(n + 1, 0), previous(n + 1, 0);
  for (std::size_t row = 1; row <= n; ++row) {
    row_of[0] = row;
    std::vector<Real> distance(n + 1, infinity);
    std::vector<char> done(n + 1, 0);
    std::size_t column = 0;
    do {
      done[column] = 1;
      const std::size_t i = row_of[column];
      std::size_t nearest = 0;
      Real least = infinity;
      for (std::size_t j = 1; j <= n; ++j) {
        if (done[j]) continue;
        const Real reduced =
            costs(static_cast<Index>(i) - 1, static_cast<Index>(j) - 1) - row_potential[i] - column_potential[j];
        if (reduced < distance[j]) distance[j] = reduced, previous[j] = column;
        if (distance[j] < least) least = distance[j], nearest = j;
      }
      for (std::size_t j = 0; j <= n; ++j) {
        if (done[j]) {
          row_potential[row_of[j]] += least;
          column_potential[j] -= least;
        } else {
          distance[j] -= least;
        }
      }
      column = nearest;
    } while (row_of[column] != 0);
    // Turn the path of alternating choices around.
    while (column != 0) {
      row_of[column] = row_of[previous[column]];
      column = previous[column];
    }
  }
  std::vector<Index> column_of(n);
  for (std::size_t j = 1; j <= n; ++j) column_of[row_of[j] - 1] = static_cast<Index>(j) - 1;
  return column_of;
}

}  // namespace gracilis
