#include <gracilis/io/tables/force_table.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>

#include <algorithm>

namespace gracilis {

namespace {

void add_on_bodies(const Scene& scene, const Pose& pose, const std::string& label, const std::vector<ForceOn>& forces,
                   RowColumns& columns) {
  for (const ForceOn& each : forces) {
    const auto body = static_cast<std::size_t>(each.on);
    columns.add(label + "_on_" + scene.bodies[body], each.wrench, pose.bodies[body]);
  }
}

void add_muscle(const Scene& scene, const Pose& pose, const std::string& name, const MuscleForces& forces,
                RowColumns& columns) {
  columns.add(name + "_tension", forces.tension);
  for (std::size_t f = 0; f < forces.fiber_tensions.size(); ++f)
    columns.add(fiber_name(name, static_cast<Index>(f)) + "_tension", forces.fiber_tensions[f]);
  add_on_bodies(scene, pose, name + "_origin", forces.origin, columns);
  add_on_bodies(scene, pose, name + "_insertion", forces.insertion, columns);
  add_on_bodies(scene, pose, name + "_fascia", forces.fascia, columns);
  for (const ForceOn& each : forces.contact) {
    const Bone& bone = scene.bones[static_cast<std::size_t>(each.on)];
    columns.add(name + "_contact_on_" + bone.name, each.wrench, pose.bodies[static_cast<std::size_t>(bone.body)]);
  }
  for (const ForceOn& each : forces.muscles)
    columns.add(name + "_contact_on_" + scene.muscles[static_cast<std::size_t>(each.on)].name + "_force",
                each.wrench.force);
  const std::vector<std::string> coordinates = coordinate_names(scene);
  for (std::size_t c = 0; c < coordinates.size(); ++c) {
    columns.add(name + "_moment_" + coordinates[c], forces.moments[c]);
    columns.add(name + "_moment_by_work_" + coordinates[c], forces.moments_by_work[c]);
  }
}

}  // namespace

std::optional<RunTable> force_table(const Scene& scene, const FrameRecord& record, int rows) {
  const std::vector<MuscleForces>& forces = record.forces;
  if (std::none_of(forces.begin(), forces.end(), [](const MuscleForces& f) { return f.is_known; })) return std::nullopt;
  RowColumns columns = begin_row(scene, record.frame.pose);
  for (std::size_t m = 0; m < forces.size(); ++m)
    if (forces[m].is_known) add_muscle(scene, record.frame.pose, scene.muscles[m].name, forces[m], columns);
  return run_table(force_file, rows, columns);
}

}  // namespace gracilis
