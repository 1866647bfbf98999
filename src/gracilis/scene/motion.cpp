#include <gracilis/scene/motion.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

Motion motion_through(const std::vector<std::string>& coordinates, const Eigen::MatrixXd& key_poses, Real step,
                      Real time_step) {
  std::vector<Eigen::RowVectorXd> rows;
  if (key_poses.rows() > 0) rows.push_back(key_poses.row(0));
  for (Index key = 1; key < key_poses.rows(); ++key) {
    const Eigen::RowVectorXd from = key_poses.row(key - 1), change = key_poses.row(key) - from;
    // The tolerance keeps a change of exactly n steps at n steps whatever the rounding.
    const int steps = std::max(1, static_cast<int>(std::ceil(change.cwiseAbs().maxCoeff() / step - 1e-9)));
    for (int i = 1; i < steps; ++i) rows.push_back(from + change * (Real(i) / steps));
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
