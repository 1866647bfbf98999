#include <gracilis/strings/cross_sections.hpp>

#include <gracilis/geometry/rotations.hpp>

namespace gracilis::strings {

std::vector<Eigen::Matrix3d> section_turns(const MuscleStrings& muscle, const Points& places) {
  std::vector<Eigen::Matrix3d> turns;
  for (Index i = 0; i < muscle.nodes; ++i) {
    Vec3 center = Vec3::Zero(), rest_center = Vec3::Zero(), direction = Vec3::Zero(), rest_direction = Vec3::Zero();
    for (Index s = 0; s < muscle.strings; ++s) {
      center += places.col(muscle.node(s, i)) / muscle.strings;
      rest_center += muscle.taut.col(muscle.node(s, i)) / muscle.strings;
      direction += string_direction(muscle, places, s, i);
      rest_direction += string_direction(muscle, muscle.taut, s, i);
    }
    Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
    Real spread = 0;
    for (Index s = 0; s < muscle.strings; ++s) {
      const Vec3 rest = muscle.taut.col(muscle.node(s, i)) - rest_center;
      correlation += (places.col(muscle.node(s, i)) - center) * rest.transpose();
      spread += rest.squaredNorm();
    }
    // The direction counts as much as all nodes, so that sections stay across the strings.
    correlation += spread * direction.normalized() * rest_direction.normalized().transpose();
    turns.push_back(nearest_rotation(correlation));
  }
  return turns;
}

}  // namespace gracilis::strings
