#include "placements.hpp"
#include "tables.hpp"

#include <gracilis/geometry/rbf_centers.hpp>

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace gracilis {

namespace {

Real variance(const HeightField& field) { return (field.heights.array() - field.heights.mean()).square().mean(); }

void write_points(std::ofstream& table, const std::string& field, const std::string& what, const Points& points) {
  for (Index i = 0; i < static_cast<Index>(points.cols()); ++i)
    table << fmt::format("{},\"{}\",{:.5g},{:.5g}\n", field, what, points(0, i), points(1, i));
}

/// The heights, and what the last placement and the greedy one make of them.
void write_heights(std::ofstream& table, const std::string& name, const HeightField& field, const RadialBasis& placed,
                   const RadialBasis& greedy) {
  const Points nodes = field.nodes();
  for (Index i = 0; i < static_cast<Index>(nodes.cols()); ++i)
    table << fmt::format("{},{:.4g},{:.4g},{:.6g},{:.6g},{:.6g}\n", name, nodes(0, i), nodes(1, i), field.heights[i],
                         value_at(placed, nodes.col(i)), value_at(greedy, nodes.col(i)));
}

/// Shares of the heights that are kept as centers, by the Halton sequence.
void compress(const TableRequest& request) {
  std::ofstream table = request.table("compression", "field,placement,share_percent,percent");
  const std::vector<Index> counts =
      request.thin ? std::vector<Index>{17, 84} : std::vector<Index>{9, 17, 30, 42, 60, 84, 120, 168, 252};
  const Index most_greedy = request.thin ? 17 : 84;
  for (const auto& [name, field] : height_fields())
    for (const Index count : counts) {
      const auto add = [&, &name = name, &field = field](const std::string& placement, Real error) {
        table << fmt::format("{},{},{:.4g},{:.4g}\n", name, placement,
                             100.0 * count / static_cast<Real>(field.heights.size()), 100 * error / variance(field));
      };
      add("Halton", best_fit(field, halton_centers(field.box(), count)).error);
      if (count <= most_greedy) add("greedy", greedy_fit(field, count).error);
    }
}

}  // namespace

void write_fields(const TableRequest& request) {
  const Index count = request.thin ? 36 : 64;
  std::ofstream errors = request.table("placements", "field,placement,functions,percent");
  std::ofstream centers = request.table("centers", "field,placement,x,y");
  std::ofstream heights = request.table("heights", "field,x,y,height,placed,greedy");
  for (const auto& [name, field] : height_fields()) {
    const auto add = [&, &name = name, &field = field](const std::string& placement, const FieldFit& found) {
      errors << fmt::format("{},\"{}\",{},{:.4g}\n", name, placement, count, 100 * found.error / variance(field));
      write_points(centers, name, placement, found.fit.basis.centers);
    };
    FieldFit placed;
    for (const Placement& each : placements()) {
      placed = best_fit(field, each.centers(field, count));
      add(each.name, placed);
    }
    const FieldFit greedy = greedy_fit(field, count);
    add("greedy", greedy);
    write_points(centers, name, "points of inflection", inflection_centers(field));
    write_heights(heights, name, field, placed.fit.basis, greedy.fit.basis);
  }
  compress(request);
}

}  // namespace gracilis
