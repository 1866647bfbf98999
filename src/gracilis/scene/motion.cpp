#include <gracilis/scene/motion.hpp>

#include <gracilis/core/errors.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

std::int64_t steps_over(Real change, Real step) {
  constexpr auto most = std::int64_t{1} << 62;
  const Real steps = std::ceil(std::abs(change) / step - 1e-9);
  if (!(steps < static_cast<Real>(most))) return most;
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(steps));
}

void require_frames(std::int64_t frames, int max_frames) {
  if (frames <= max_frames) return;
  throw ConfigurationError({"", "[motion]", "the motion asks for more than " + std::to_string(max_frames) + " frames",
                            "take larger steps or a shorter motion, or set 'max_frames' higher"});
}

Motion motion_through(const std::vector<std::string>& coordinates, const Eigen::MatrixXd& key_poses, Real step,
                      Real time_step, int max_frames) {
  std::vector<Eigen::RowVectorXd> rows;
  if (key_poses.rows() > 0) rows.push_back(key_poses.row(0));
  for (Index key = 1; key < key_poses.rows(); ++key) {
    const Eigen::RowVectorXd from = key_poses.row(key - 1), change = key_poses.row(key) - from;
    const std::int64_t steps = steps_over(change.cwiseAbs().maxCoeff(), step);
    require_frames(steps > max_frames ? steps : static_cast<std::int64_t>(rows.size()) + steps, max_frames);
    for (std::int64_t i = 1; i < steps; ++i)
      rows.push_back(from + change * (static_cast<Real>(i) / static_cast<Real>(steps)));
    rows.push_back(key_poses.row(key));
  }

  Motion motion;
  motion.coordinates = coordinates;
  motion.values.resize(static_cast<Index>(rows.size()), key_poses.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    motion.values.row(static_cast<Index>(i)) = rows[i];
    motion.times.push_back(Real(i) * time_step);
  }
  return motion;
}

Eigen::VectorXd values_through(Real from, Real to, Real step, int max_count) {
  return motion_through({}, Eigen::Vector2d(from, to), step, 0, max_count).values.col(0);
}

Motion motion_over_grid(const std::vector<std::string>& coordinates, const std::vector<Eigen::VectorXd>& values,
                        Real time_step, int max_frames) {
  std::int64_t rows = 1;
  for (const Eigen::VectorXd& each : values) {
    rows *= each.size();
    require_frames(rows, max_frames);
  }
  Motion motion;
  motion.coordinates = coordinates;
  motion.values.resize(static_cast<Index>(rows), static_cast<Index>(values.size()));
  for (Index row = 0; row < motion.values.rows(); ++row) {
    motion.times.push_back(Real(row) * time_step);
    Index way = row;  // how many values of this coordinate have been gone through
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto count = static_cast<Index>(values[k].size());
      const Index lap = way / count, forth = way % count;
      motion.values(row, static_cast<Index>(k)) = values[k][lap % 2 == 0 ? forth : count - 1 - forth];
      way = lap;
    }
  }
  return motion;
}

void thin_out(Motion& motion, Real begin, Real end, Real time_step) {
  std::vector<Real> times;
  std::vector<Index> rows;
  const Real rounding = 1e-6 * time_step;
  for (std::size_t row = 0; row < motion.times.size(); ++row) {
    const Real time = motion.times[row];
    if (time < begin - rounding || time > end + rounding) continue;
    if (!times.empty() && time - times.back() < time_step - rounding) continue;
    times.push_back(time);
    rows.push_back(static_cast<Index>(row));
  }
  motion.values = motion.values(rows, Eigen::all).eval();
  motion.times = std::move(times);
}

std::vector<std::string> drop_unknown_coordinates(Motion& motion, const std::vector<std::string>& known) {
  std::vector<std::string> kept, dropped;
  Eigen::MatrixXd values(motion.values.rows(), motion.values.cols());
  for (std::size_t column = 0; column < motion.coordinates.size(); ++column) {
    const std::string& coordinate = motion.coordinates[column];
    if (std::find(known.begin(), known.end(), coordinate) == known.end()) {
      dropped.push_back(coordinate);
      continue;
    }
    values.col(static_cast<Index>(kept.size())) = motion.values.col(static_cast<Index>(column));
    kept.push_back(coordinate);
  }
  motion.values = values.leftCols(static_cast<Index>(kept.size())).eval();
  motion.coordinates = std::move(kept);
  return dropped;
}

}  // namespace gracilis
