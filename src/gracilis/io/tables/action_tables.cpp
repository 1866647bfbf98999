#include <gracilis/io/tables/action_tables.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/scene/names.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

constexpr const char* lines_of_action_file = "lines_of_action.sto";

/// Labels and numbers of one row, which grow together.
struct Columns {
  std::string labels = "time", row;
  std::size_t count = 1;

  void add(const std::string& label, Real value) {
    labels += "\t" + label;
    row += fmt::format("\t{:.9g}", std::isfinite(value) ? value : 0);
    ++count;
  }
  void add(const std::string& label, const Vec3& vector) {
    for (int axis = 0; axis < 3; ++axis) add(fmt::format("{}_{}", label, "xyz"[axis]), vector[axis]);
  }
};

Columns begun(const Scene& scene, const Pose& pose) {
  Columns columns;
  columns.row = fmt::format("{}", pose.time);
  std::size_t coordinate = 0;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes) {
      const Real value = pose.coordinates[coordinate++];
      columns.add(axis.coordinate, axis.translation ? value : degrees(value));
    }
  return columns;
}

ActionTable table(const std::string& file, int rows, const Columns& columns) {
  const std::string name = file.substr(0, file.rfind('.'));
  return {file,
          fmt::format("{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees=yes\nendheader\n{}\n", name, rows, columns.count,
                      columns.labels),
          columns.row + "\n"};
}

std::string fiber_name(const std::string& muscle, Index fiber) { return fmt::format("{}_f{:03}", muscle, fiber); }

void add_arms(const std::string& muscle, const FiberActions& actions, Index coordinate, Columns& columns) {
  columns.add(muscle, actions.mean_arms[coordinate]);
  for (Index f = 0; f < actions.arms.rows(); ++f) columns.add(fiber_name(muscle, f), actions.arms(f, coordinate));
  const auto left_out = std::count(actions.doubtful.begin(), actions.doubtful.end(), 1);
  columns.add(muscle + "_left_out", static_cast<Real>(left_out));
}

void add_lines(const Scene& scene, const Pose& pose, const std::string& muscle, const FiberActions& actions,
               Columns& columns) {
  for (Index f = 0; f < actions.arms.rows(); ++f) {
    const std::string name = fiber_name(muscle, f);
    columns.add(name + "_origin", Vec3(actions.origin_directions.col(f)));
    columns.add(name + "_insertion", Vec3(actions.insertion_directions.col(f)));
    columns.add(name + "_left_out", actions.doubtful[static_cast<std::size_t>(f)]);
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Vec3 force = actions.wrenches.col(static_cast<Index>(b)).head<3>();
    const Vec3 moment = actions.wrenches.col(static_cast<Index>(b)).tail<3>();
    const std::string name = muscle + "_on_" + scene.bodies[b];
    columns.add(name + "_force", force);
    columns.add(name + "_moment", Vec3(moment - pose.bodies[b].translation().cross(force)));
  }
}

}  // namespace

std::string moment_arm_file(const std::string& coordinate) {
  return "moment_arms_" + file_name_of(coordinate) + ".sto";
}

std::vector<std::string> fiber_tables(const Scene& scene) {
  std::vector<std::string> names = {"fiber_lengths.sto", lines_of_action_file};
  for (const std::string& coordinate : coordinate_names(scene)) names.push_back(moment_arm_file(coordinate));
  return names;
}

std::vector<ActionTable> action_tables(const Scene& scene, const FrameRecord& record, int rows) {
  const std::vector<FiberActions>& actions = record.actions;
  if (std::all_of(actions.begin(), actions.end(), [](const FiberActions& a) { return a.arms.rows() == 0; })) return {};
  const Pose& pose = record.frame.pose;
  std::vector<ActionTable> tables;
  const std::vector<std::string> coordinates = coordinate_names(scene);
  for (std::size_t c = 0; c < coordinates.size(); ++c) {
    Columns columns = begun(scene, pose);
    for (std::size_t m = 0; m < actions.size(); ++m)
      if (actions[m].arms.rows() > 0) add_arms(scene.muscles[m].name, actions[m], static_cast<Index>(c), columns);
    tables.push_back(table(moment_arm_file(coordinates[c]), rows, columns));
  }
  Columns columns = begun(scene, pose);
  for (std::size_t m = 0; m < actions.size(); ++m)
    if (actions[m].arms.rows() > 0) add_lines(scene, pose, scene.muscles[m].name, actions[m], columns);
  tables.push_back(table(lines_of_action_file, rows, columns));
  return tables;
}

}  // namespace gracilis
