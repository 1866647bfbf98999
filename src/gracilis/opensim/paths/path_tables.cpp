#include <gracilis/opensim/paths/path_tables.hpp>

#include <gracilis/opensim/kinematics/loop_closer.hpp>
#include <gracilis/opensim/paths/length_by_opensim.hpp>

namespace gracilis::opensim {

PathTables path_tables(const Model& model, const CoordinateMotion& motion) {
  const auto rows = static_cast<Eigen::Index>(motion.times.size());
  Table empty;
  empty.times = motion.times;
  for (const Muscle& muscle : model.muscles) empty.columns.push_back(muscle.name);
  empty.values.setZero(rows, static_cast<Eigen::Index>(model.muscles.size()));
  PathTables tables{empty, empty, {}};
  tables.lengths.name = tables.way_lengths.name = "Length";
  std::vector<Table> arms(model.coordinates.size(), empty);
  Skeleton skeleton(model);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Eigen::VectorXd coordinates = motion.values.row(row);
    skeleton.place(coordinates);
    const Eigen::MatrixXd motions = model.loops.empty() ? Eigen::MatrixXd() : free_motions(skeleton, coordinates);
    for (std::size_t i = 0; i < model.muscles.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      PathMeasure measure = measure_path(skeleton, model.muscles[i].path, coordinates);
      if (!model.loops.empty()) measure.moment_arms = arms_through_loops(motions, measure.moment_arms);
      tables.lengths.values(row, column) = length_by_opensim(skeleton, model.muscles[i].path, coordinates);
      tables.way_lengths.values(row, column) = measure.length;
      for (std::size_t c = 0; c < arms.size(); ++c)
        arms[c].values(row, column) = measure.moment_arms[static_cast<Eigen::Index>(c)];
    }
  }
  for (std::size_t c = 0; c < arms.size(); ++c) {
    // A path that ends on both sides of a joint it does not cross leaves rounding errors only.
    if (arms[c].values.cwiseAbs().maxCoeff() < 1e-9) continue;
    arms[c].name = "MomentArm_" + model.coordinates[c].name;
    tables.moment_arms.emplace_back(model.coordinates[c].name, std::move(arms[c]));
  }
  return tables;
}

std::vector<LengthsApart> lengths_apart(const PathTables& tables) {
  const Eigen::RowVectorXd most = (tables.lengths.values - tables.way_lengths.values).cwiseAbs().colwise().maxCoeff();
  std::vector<LengthsApart> apart;
  for (std::size_t i = 0; i < tables.lengths.columns.size(); ++i)
    if (const Real difference = most[static_cast<Eigen::Index>(i)]; difference > 1e-4)
      apart.push_back({tables.lengths.columns[i], difference});
  return apart;
}

}  // namespace gracilis::opensim
