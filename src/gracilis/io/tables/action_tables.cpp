#include <gracilis/io/tables/action_tables.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/io/tables/force_table.hpp>
#include <gracilis/scene/names.hpp>

#include <algorithm>
#include <set>

namespace gracilis {

namespace {

constexpr const char* lines_of_action_file = "lines_of_action.sto";

void add_arms(const std::string& muscle, const FiberActions& actions, Index coordinate, RowColumns& columns) {
  columns.add(muscle, actions.mean_arms[coordinate]);
  for (Index f = 0; f < actions.arms.rows(); ++f) columns.add(fiber_name(muscle, f), actions.arms(f, coordinate));
  const auto doubtful = std::count(actions.doubtful.begin(), actions.doubtful.end(), 1);
  columns.add(muscle + "_doubtful", static_cast<Real>(doubtful));
}

void add_lines(const Scene& scene, const Pose& pose, const std::string& muscle, const FiberActions& actions,
               RowColumns& columns) {
  for (Index f = 0; f < actions.arms.rows(); ++f) {
    const std::string name = fiber_name(muscle, f);
    columns.add(name + "_origin", Vec3(actions.origin_directions.col(f)));
    columns.add(name + "_insertion", Vec3(actions.insertion_directions.col(f)));
    columns.add(name + "_doubtful", actions.doubtful[static_cast<std::size_t>(f)]);
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const auto wrench = actions.wrenches.col(static_cast<Index>(b));
    columns.add(muscle + "_on_" + scene.bodies[b], {wrench.head<3>(), wrench.tail<3>()}, pose.bodies[b]);
  }
}

bool any_arms(const std::vector<FiberActions>& actions) {
  return std::any_of(actions.begin(), actions.end(), [](const FiberActions& a) { return a.arms.rows() > 0; });
}

}  // namespace

std::string moment_arm_file(const std::string& coordinate, const std::vector<std::string>& coordinates) {
  std::set<std::string> taken;
  for (const std::string& each : coordinates) {
    if (each == coordinate) break;
    file_name_of(each, taken);
  }
  return "moment_arms_" + file_name_of(coordinate, taken) + ".sto";
}

std::vector<std::string> table_names(const Scene& scene) {
  std::vector<std::string> names = {"fiber_lengths.sto", lines_of_action_file, force_file};
  const std::vector<std::string> coordinates = coordinate_names(scene);
  for (const std::string& each : coordinates) names.push_back(moment_arm_file(each, coordinates));
  return names;
}

std::vector<RunTable> moment_arm_tables(const Scene& scene, const FrameRecord& record, int rows) {
  const std::vector<FiberActions>& actions = record.actions;
  std::vector<RunTable> tables;
  if (!any_arms(actions)) return tables;
  const std::vector<std::string> coordinates = coordinate_names(scene);
  for (std::size_t c = 0; c < coordinates.size(); ++c) {
    RowColumns columns = begin_row(scene, record.frame.pose);
    for (std::size_t m = 0; m < actions.size(); ++m)
      if (actions[m].arms.rows() > 0) add_arms(scene.muscles[m].name, actions[m], static_cast<Index>(c), columns);
    tables.push_back(run_table(moment_arm_file(coordinates[c], coordinates), rows, columns));
  }
  return tables;
}

std::vector<RunTable> action_tables(const Scene& scene, const FrameRecord& record, int rows) {
  const std::vector<FiberActions>& actions = record.actions;
  std::vector<RunTable> tables = moment_arm_tables(scene, record, rows);
  if (tables.empty()) return tables;
  const Pose& pose = record.frame.pose;
  RowColumns columns = begin_row(scene, pose);
  for (std::size_t m = 0; m < actions.size(); ++m)
    if (actions[m].arms.rows() > 0) add_lines(scene, pose, scene.muscles[m].name, actions[m], columns);
  tables.push_back(run_table(lines_of_action_file, rows, columns));
  return tables;
}

}  // namespace gracilis
