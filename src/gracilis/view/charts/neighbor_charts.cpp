#include <gracilis/view/charts/neighbor_charts.hpp>

#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/view/charts/line_chart.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace gracilis {

int AskedSamples::used() const {
  return static_cast<int>(std::count_if(asked.begin(), asked.end(), [](int poses) { return poses > 0; }));
}

AskedSamples asked_samples(const JointControlUnit& unit, const Eigen::MatrixXd& poses) {
  const JointControl control(unit);
  AskedSamples result{unit.coordinates, control.angles_deg(), poses * degrees(1), {}};
  result.asked.resize(static_cast<std::size_t>(result.samples.rows()));
  for (Index i = 0; i < poses.rows(); ++i)
    for (const Index sample : control.neighbors(poses.row(i).transpose()))
      ++result.asked[static_cast<std::size_t>(sample)];
  return result;
}

/// One coordinate of samples, all of them or those that are asked.
static std::vector<Real> values_of(const AskedSamples& asked, Index coordinate, bool only_asked) {
  std::vector<Real> values;
  for (Index i = 0; i < asked.samples.rows(); ++i)
    if (!only_asked || asked.asked[static_cast<std::size_t>(i)] > 0)
      values.push_back(coordinate < 0 ? 0 : asked.samples(i, coordinate));
  return values;
}

/// One coordinate across, another (or, below 0, none) up.
static LineChart chart_of(const AskedSamples& asked, Index across, Index up) {
  const auto name = [&](Index c) { return c < 0 ? "" : asked.coordinates[static_cast<std::size_t>(c)] + ", degrees"; };
  const auto of_poses = [&](Index c) {
    const Eigen::VectorXd column =
        c < 0 ? Eigen::VectorXd::Zero(asked.poses.rows()) : Eigen::VectorXd(asked.poses.col(c));
    return std::vector<Real>(column.begin(), column.end());
  };
  const std::string title =
      fmt::format("{} of {} samples are asked in {} poses", asked.used(), asked.samples.rows(), asked.poses.rows());
  return {title,
          name(across),
          name(up),
          {{"samples", values_of(asked, across, false), values_of(asked, up, false), Color::Constant(0.73), 1, 3},
           {"asked", values_of(asked, across, true), values_of(asked, up, true), Color(0.00, 0.45, 0.70), 1, 4},
           {"poses", of_poses(across), of_poses(up), Color(0.84, 0.37, 0.00), 2}}};
}

void write_asked_samples(const std::filesystem::path& folder, const AskedSamples& asked) {
  create_folder_of(folder / "neighbors.csv");
  Table table;
  for (const std::string& name : asked.coordinates) table.columns.push_back(name + "_deg");
  table.columns.push_back("poses");
  table.values.resize(asked.samples.rows(), asked.samples.cols() + 1);
  table.values.leftCols(asked.samples.cols()) = asked.samples;
  for (Index i = 0; i < asked.samples.rows(); ++i)
    table.values(i, asked.samples.cols()) = asked.asked[static_cast<std::size_t>(i)];
  write_csv(folder / "neighbors.csv", table);
  const auto count = static_cast<Index>(asked.coordinates.size());
  if (count == 1) write_chart(folder / (asked.coordinates[0] + ".svg"), chart_of(asked, 0, -1));
  for (Index a = 0; a < count; ++a)
    for (Index b = a + 1; b < count; ++b)
      write_chart(folder / fmt::format("{}_{}.svg", asked.coordinates[static_cast<std::size_t>(a)],
                                       asked.coordinates[static_cast<std::size_t>(b)]),
                  chart_of(asked, a, b));
}

}  // namespace gracilis
