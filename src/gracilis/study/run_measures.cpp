#include <gracilis/study/run_measures.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/content_hash.hpp>
#include <gracilis/io/csv_rows.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/run/output_hashes.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/io/value_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace gracilis {

namespace fs = std::filesystem;

/// What measures and coordinates end with, and what stands for it in a table.
static constexpr std::array<std::pair<std::string_view, std::string_view>, 9> unit_endings = {{{"_mm", "mm"},
                                                                                               {"_deg", "deg"},
                                                                                               {"_cm2", "cm2"},
                                                                                               {"_cm3", "cm3"},
                                                                                               {"_m", "m"},
                                                                                               {"_s", "s"},
                                                                                               {"_kpa", "kPa"},
                                                                                               {"_pa", "Pa"},
                                                                                               {"_n", "N"}}};

MetricName metric_name(const std::string& column) {
  if (column == "milliseconds") return {"computing_time", "ms"};
  for (const auto& [ending, unit] : unit_endings)
    if (column.size() > ending.size() && column.ends_with(ending))
      return {column.substr(0, column.size() - ending.size()), std::string(unit)};
  return {column, "1"};
}

/// The text of a file, which must be what the run's list of hashes tells of.
static std::string read_sealed(const fs::path& folder, const std::vector<OutputHash>& outputs,
                               const std::string& name) {
  const fs::path file = folder / name;
  std::string text = read_text(file);
  const auto sealed = std::find_if(outputs.begin(), outputs.end(), [&](const auto& each) { return each.file == name; });
  const char* trouble = sealed == outputs.end()                   ? "is not in the run's list of hashes"
                        : sealed->sha256 != content_hash_of(text) ? "has changed since the run ended"
                                                                  : nullptr;
  if (trouble) throw InputError({file.string(), "", trouble, "remove the run's folder and run it again"});
  return text;
}

/// Mean lengths of fibers, a column per muscle, become one more metric.
static void add_fiber_lengths(const fs::path& folder, const std::vector<OutputHash>& outputs, RunMeasures& measures) {
  const fs::path file = folder / "fiber_lengths.sto";
  if (!is_there(file)) return;
  read_sealed(folder, outputs, "fiber_lengths.sto");
  const Table table = read_table(file);
  measures.metrics.push_back({"fiber_length", "mm"});
  for (RunMeasures::Row& row : measures.rows) {
    const std::optional<Eigen::Index> column = column_of(table, measures.muscles[row.muscle]);
    const bool is_known = column && row.frame < static_cast<int>(table.times.size());
    row.cells.push_back(is_known ? fmt::format("{:.6f}", 1000 * table.values(row.frame, *column)) : "");
  }
}

RunMeasures read_run_measures(const fs::path& folder) {
  const std::vector<OutputHash> outputs = read_output_hashes(folder);
  const std::string text = read_sealed(folder, outputs, "measures.csv");
  CsvRows rows(folder / "measures.csv", text);
  const std::optional<std::size_t> frame = rows.column("frame"), time = rows.column("time_s"),
                                   muscle = rows.column("muscle");
  if (!frame || !time || !muscle) rows.fail("has no columns frame, time_s and muscle", "run the scene again");
  RunMeasures measures;
  for (std::size_t c = *time + 1; c < *muscle; ++c) measures.coordinates.emplace_back(rows.labels()[c]);
  for (std::size_t c = *muscle + 1; c < rows.labels().size(); ++c)
    measures.metrics.push_back(metric_name(std::string(rows.labels()[c])));
  std::map<std::string, std::size_t, std::less<>> numbers;
  std::set<std::pair<Index, std::size_t>> seen;
  while (rows.next()) {
    RunMeasures::Row row;
    if (!parse_index(rows.cell(*frame), row.frame))
      rows.fail("'" + std::string(rows.cell(*frame)) + "' is not the number of a frame", "run the scene again");
    row.time = rows.number(*time, "a time");
    const std::string name(rows.cell(*muscle));
    const auto [found, is_new] = numbers.try_emplace(name, numbers.size());
    if (is_new) measures.muscles.push_back(name);
    row.muscle = found->second;
    if (!seen.emplace(row.frame, row.muscle).second)
      rows.fail(fmt::format("frame {} has two rows of '{}'", row.frame, name), "run the scene again");
    for (std::size_t c = *time + 1; c < *muscle; ++c) row.pose.emplace_back(rows.cell(c));
    for (std::size_t c = *muscle + 1; c < rows.labels().size(); ++c) row.cells.emplace_back(rows.cell(c));
    measures.rows.push_back(std::move(row));
  }
  add_fiber_lengths(folder, outputs, measures);
  return measures;
}

}  // namespace gracilis
