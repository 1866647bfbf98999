#include "conditions.hpp"
#include "tables.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

namespace gracilis {

void write_conditions(const TableRequest& request) {
  const std::vector<std::pair<std::string, ConditionMap>> maps = {
      {"gaussian grid", {RadialShape::gaussian, true}},
      {"gaussian Halton", {RadialShape::gaussian, false}},
      {"thin-plate grid", {RadialShape::thin_plate, true}},
      {"thin-plate Halton", {RadialShape::thin_plate, false}}};
  const int most_side = request.thin ? 8 : 16, columns = request.thin ? 17 : 41, side_step = request.thin ? 2 : 1;
  constexpr Real low = -0.5, high = 3.5;
  std::ofstream conditions = request.table("conditions", "map,functions,log_alpha,log_condition");
  for (const auto& [name, map] : maps)
    for (int side = most_side; side >= 3; side -= side_step)
      for (int a = 0; a < columns; ++a) {
        const Real log_alpha = low + (high - low) * a / (columns - 1);
        conditions << fmt::format("{},{},{:.4g},{:.6g}\n", name, side * side, log_alpha,
                                  log_condition(map, side, log_alpha));
      }
  std::ofstream peaks = request.table("peaks", "map,functions,log_alpha,log_condition");
  for (const auto& [name, map] : maps)
    for (int side = 3; side <= (request.thin ? 5 : 10); ++side) {
      const bool is_plate = map.shape == RadialShape::thin_plate;
      const std::vector<ConditionPeak> found =
          is_plate ? condition_peaks(map, side, -1, 1, 401) : condition_peaks(map, side, -0.5, 3.5, 161);
      for (const ConditionPeak& peak : found)
        peaks << fmt::format("{},{},{:.9g},{:.4g}\n", name, side * side, peak.log_alpha, peak.log_condition);
      if (found.empty()) peaks << fmt::format("{},{},,\n", name, side * side);
    }
}

}  // namespace gracilis
