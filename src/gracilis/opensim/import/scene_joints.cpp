#include <gracilis/opensim/import/scene_joints.hpp>

#include <algorithm>

namespace gracilis::opensim {

/// Whether the axis moves by just the coordinate.
static bool is_plain(const TransformAxis& axis) {
  const Function& f = axis.function;
  return axis.coordinates.size() == 1 && f.kind == Function::Kind::linear && f.coefficients[0] * f.scale == 1 &&
         f.coefficients[1] == 0;
}

std::vector<SceneAxis> scene_axes(const Model& model, const Joint& joint) {
  static const char* names[6] = {"rotation1", "rotation2", "rotation3", "translation1", "translation2", "translation3"};
  std::vector<SceneAxis> axes;
  std::vector<Index> taken;
  for (const std::size_t i : {3u, 4u, 5u, 0u, 1u, 2u}) {
    const TransformAxis& axis = joint.axes[i];
    if (axis.coordinates.empty() && value(axis.function, {}) == 0) continue;
    SceneAxis result{joint.name + "_" + names[i], &axis, i >= 3};
    if (result.translation) {
      result.range_min = -10;
      result.range_max = 10;
    }
    const Index coordinate = axis.coordinates.empty() ? -1 : axis.coordinates[0];
    if (is_plain(axis) && std::find(taken.begin(), taken.end(), coordinate) == taken.end()) {
      const Coordinate& given = model.coordinates[static_cast<std::size_t>(coordinate)];
      taken.push_back(coordinate);
      result.coordinate = given.name;
      result.range_min = given.range_min;
      result.range_max = given.range_max;
    }
    axes.push_back(result);
  }
  return axes;
}

Real scene_bound(Real bound) { return std::clamp(bound, Real{-1e6}, Real{1e6}); }

Real value_of(const SceneAxis& axis, const Eigen::VectorXd& coordinates) {
  std::vector<Real> arguments;
  for (const Index i : axis.axis->coordinates) arguments.push_back(coordinates[i]);
  return value(axis.axis->function, arguments);
}

std::optional<SceneCoordinate> scene_coordinate(const Model& model, Index coordinate) {
  const Index joint = model.coordinates[static_cast<std::size_t>(coordinate)].joint;
  for (const SceneAxis& axis : scene_axes(model, model.joints[static_cast<std::size_t>(joint)])) {
    const Function& f = axis.axis->function;
    if (axis.axis->coordinates != std::vector<Index>{coordinate} || f.kind != Function::Kind::linear) continue;
    const Real slope = f.scale * f.coefficients[0];
    if (slope != 0) return SceneCoordinate{axis.coordinate, slope, f.scale * f.coefficients[1], axis.translation};
  }
  return {};
}

Table scene_motion(const Model& model, const CoordinateMotion& motion, const std::string& name) {
  Table table;
  table.name = name;
  table.times = motion.times;
  std::vector<SceneAxis> axes;
  for (const Joint& joint : model.joints)
    for (const SceneAxis& axis : scene_axes(model, joint)) axes.push_back(axis);
  table.values.resize(motion.values.rows(), static_cast<Eigen::Index>(axes.size()));
  for (const SceneAxis& axis : axes) table.columns.push_back(axis.coordinate);
  for (Eigen::Index row = 0; row < motion.values.rows(); ++row)
    for (std::size_t i = 0; i < axes.size(); ++i)
      table.values(row, static_cast<Eigen::Index>(i)) = value_of(axes[i], motion.values.row(row));
  return table;
}

}  // namespace gracilis::opensim
