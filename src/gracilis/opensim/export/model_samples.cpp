#include <gracilis/opensim/export/model_samples.hpp>

#include <gracilis/geometry/sobol_points.hpp>
#include <gracilis/opensim/kinematics/loop_closer.hpp>
#include <gracilis/opensim/paths/muscle_path.hpp>

#include <algorithm>

namespace gracilis::opensim {

static const Coordinate& coordinate_of(const Model& model, const CoordinateBox& box, Eigen::Index i) {
  return model.coordinates[static_cast<std::size_t>(box.coordinates[static_cast<std::size_t>(i)])];
}

Eigen::VectorXd CoordinateBox::scales(const Model& model) const {
  Eigen::VectorXd scales = Eigen::VectorXd::Ones(least.size());
  for (Eigen::Index i = 0; i < least.size(); ++i)
    if (!coordinate_of(model, *this, i).rotation) scales[i] = std::max((most[i] - least[i]) / 2, 1e-6);
  return scales;
}

Eigen::MatrixXd spread_poses(const CoordinateBox& box, Eigen::Index count, Eigen::Index skip) {
  Eigen::MatrixXd poses = sobol_points(count, static_cast<int>(box.coordinates.size()), skip);
  for (Eigen::Index i = 0; i < poses.cols(); ++i)
    poses.col(i) = box.least[i] + (box.most[i] - box.least[i]) * poses.col(i).array();
  return poses;
}

PathSamples model_samples(Skeleton& skeleton, const Path& path, const CoordinateBox& box,
                          const Eigen::MatrixXd& poses) {
  const Model& model = skeleton.model();
  PathSamples samples{poses, Eigen::VectorXd(poses.rows()), Eigen::MatrixXd(poses.rows(), poses.cols()),
                      box.scales(model)};
  LoopCloser closer(model);
  std::vector<bool> held(model.coordinates.size(), false);
  for (const Index i : box.coordinates) held[static_cast<std::size_t>(i)] = true;
  for (Eigen::Index row = 0; row < poses.rows(); ++row) {
    Eigen::VectorXd values = default_coordinates(model);
    for (std::size_t i = 0; i < box.coordinates.size(); ++i)
      values[box.coordinates[i]] = poses(row, static_cast<Eigen::Index>(i));
    closer.close(values, held);
    skeleton.place(values);
    const PathMeasure measure = measure_path(skeleton, path, values);
    samples.lengths[row] = measure.length;
    for (std::size_t i = 0; i < box.coordinates.size(); ++i)
      samples.arms(row, static_cast<Eigen::Index>(i)) = measure.moment_arms[box.coordinates[i]];
  }
  return samples;
}

CoordinateBox box_around(const Model& model, const std::vector<Index>& coordinates, const Eigen::MatrixXd& values,
                         bool whole_ranges, Real margin) {
  CoordinateBox box{coordinates, Eigen::VectorXd(coordinates.size()), Eigen::VectorXd(coordinates.size())};
  for (Eigen::Index i = 0; i < box.least.size(); ++i) {
    const Coordinate& coordinate = coordinate_of(model, box, i);
    const auto column = values.col(box.coordinates[static_cast<std::size_t>(i)]);
    const Real least = column.minCoeff(), most = column.maxCoeff();
    const Real more = coordinate.rotation ? margin : 0.1 * (most - least);
    box.least[i] = whole_ranges ? coordinate.range_min : std::min(least, std::max(coordinate.range_min, least - more));
    box.most[i] = whole_ranges ? coordinate.range_max : std::max(most, std::min(coordinate.range_max, most + more));
  }
  return box;
}

}  // namespace gracilis::opensim
