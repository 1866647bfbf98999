#include <gracilis/strings/cross_sections.hpp>

#include <gracilis/geometry/rotations.hpp>

namespace gracilis::strings {

StringSection string_section(const MuscleStrings& muscle, const Points& places, Index i) {
  StringSection section;
  for (Index s = 0; s < muscle.strings; ++s) {
    section.center += places.col(muscle.node(s, i)) / muscle.strings;
    section.direction += string_direction(muscle, places, s, i);
  }
  for (Index s = 0; s < muscle.strings; ++s)
    section.spread += (places.col(muscle.node(s, i)) - section.center).squaredNorm();
  return section;
}

std::vector<Eigen::Matrix3d> section_turns(const MuscleStrings& muscle, const Points& places) {
  std::vector<Eigen::Matrix3d> turns;
  for (Index i = 0; i < muscle.nodes; ++i) {
    const StringSection rest = string_section(muscle, muscle.taut, i), now = string_section(muscle, places, i);
    Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
    for (Index s = 0; s < muscle.strings; ++s) {
      const Index p = muscle.node(s, i);
      correlation += (places.col(p) - now.center) * (muscle.taut.col(p) - rest.center).transpose();
    }
    // The direction counts as much as all nodes, so that sections stay across the strings.
    correlation += rest.spread * now.direction.normalized() * rest.direction.normalized().transpose();
    turns.push_back(nearest_rotation(correlation));
  }
  return turns;
}

}  // namespace gracilis::strings
