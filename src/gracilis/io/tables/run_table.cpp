#include <gracilis/io/tables/run_table.hpp>

#include <gracilis/core/errors.hpp>

#include <fmt/format.h>

#include <cmath>

namespace gracilis {

void RowColumns::add(const std::string& label, Real value) {
  if (!std::isfinite(value))
    throw QualityError(fmt::format("{} is not finite at {} s; check the pose", label, row.substr(0, row.find('\t'))));
  labels += "\t" + label;
  row += fmt::format("\t{:.9g}", value);
  ++count;
}

void RowColumns::add(const std::string& label, const Vec3& vector) {
  for (int axis = 0; axis < 3; ++axis) add(fmt::format("{}_{}", label, "xyz"[axis]), vector[axis]);
}

void RowColumns::add(const std::string& label, const Wrench& wrench, const RigidTransform& body) {
  add(label + "_force", wrench.force);
  add(label + "_moment", Vec3(wrench.moment - body.translation().cross(wrench.force)));
}

RowColumns begin_row(const Scene& scene, const Pose& pose) {
  RowColumns columns;
  columns.row = fmt::format("{}", pose.time);
  std::size_t coordinate = 0;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes) {
      const Real value = pose.coordinates[coordinate++];
      columns.add(axis.coordinate, axis.translation ? value : degrees(value));
    }
  return columns;
}

RunTable run_table(const std::string& file, int rows, const RowColumns& columns) {
  const std::string name = file.substr(0, file.rfind('.'));
  return {file,
          fmt::format("{}\nversion=1\nnRows={}\nnColumns={}\ninDegrees=yes\nendheader\n{}\n", name, rows, columns.count,
                      columns.labels),
          columns.row + "\n"};
}

std::string fiber_name(const std::string& muscle, Index fiber) { return fmt::format("{}_f{:03}", muscle, fiber); }

}  // namespace gracilis
