#include <gracilis/opensim/export/arm_courses.hpp>

#include <gracilis/opensim/kinematics/loop_closer.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

/// Rows of poses in which one coordinate goes through its range.
static Eigen::MatrixXd poses_along(const Model& model, const Eigen::MatrixXd& coordinates, Index moving, int steps) {
  const auto column = coordinates.col(moving);
  LoopCloser closer(model);
  std::vector<bool> held(model.coordinates.size(), false);
  held[static_cast<std::size_t>(moving)] = true;
  Eigen::VectorXd pose = coordinates.colwise().mean();
  Eigen::MatrixXd poses(steps + 1, coordinates.cols());
  for (int i = 0; i <= steps; ++i) {
    pose[moving] = column.minCoeff() + (column.maxCoeff() - column.minCoeff()) * i / steps;
    closer.close(pose, held);
    poses.row(i) = pose;
  }
  return poses;
}

/// Arms of all muscles about the coordinate: poses × muscles.
static Eigen::MatrixXd arms_about(const Model& model, const Eigen::MatrixXd& poses, Index coordinate) {
  Skeleton skeleton(model);
  Eigen::MatrixXd arms(poses.rows(), static_cast<Eigen::Index>(model.muscles.size()));
  for (Eigen::Index row = 0; row < poses.rows(); ++row) {
    skeleton.place(poses.row(row));
    for (std::size_t m = 0; m < model.muscles.size(); ++m)
      arms(row, static_cast<Eigen::Index>(m)) =
          measure_path(skeleton, model.muscles[m].path, poses.row(row)).moment_arms[coordinate];
  }
  return arms;
}

std::vector<ArmCourse> arm_courses(const Model& before, const Model& after, const Eigen::MatrixXd& coordinates,
                                   int steps) {
  std::vector<ArmCourse> courses;
  for (std::size_t c = 0; c < before.coordinates.size(); ++c) {
    const auto index = static_cast<Index>(c);
    const Coordinate& coordinate = before.coordinates[c];
    const auto column = coordinates.col(index);
    const Real enough = coordinate.rotation ? radians(1) : 0.001;
    if (is_dependent(before, index) || column.maxCoeff() - column.minCoeff() < enough) continue;
    const Eigen::MatrixXd poses = poses_along(before, coordinates, index, steps);
    const Eigen::MatrixXd own = arms_about(before, poses, index), other = arms_about(after, poses, index);
    const auto first = static_cast<std::ptrdiff_t>(courses.size());
    for (std::size_t m = 0; m < before.muscles.size(); ++m) {
      const auto k = static_cast<Eigen::Index>(m);
      if (own.col(k).cwiseAbs().maxCoeff() < 1e-3 && other.col(k).cwiseAbs().maxCoeff() < 1e-3) continue;
      const Eigen::VectorXd at = poses.col(index), a = own.col(k), b = other.col(k);
      courses.push_back({coordinate.name,
                         before.muscles[m].name,
                         coordinate.rotation,
                         {at.begin(), at.end()},
                         {a.begin(), a.end()},
                         {b.begin(), b.end()},
                         std::sqrt((b - a).squaredNorm() / static_cast<Real>(a.size())),
                         (b - a).cwiseAbs().maxCoeff()});
    }
    std::stable_sort(courses.begin() + first, courses.end(),
                     [](const ArmCourse& x, const ArmCourse& y) { return x.root_mean_square > y.root_mean_square; });
  }
  return courses;
}

}  // namespace gracilis::opensim
