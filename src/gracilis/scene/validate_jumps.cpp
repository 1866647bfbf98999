#include <gracilis/scene/validate_jumps.hpp>

#include <cmath>
#include <cstdio>
#include <set>
#include <string>

namespace gracilis {

static constexpr Real longest_jump = 100;  ///< m; followed in steps of millimetres

std::vector<Problem> jump_problems(const Scene& scene) {
  const Motion& motion = scene.motion;
  std::set<std::string> translations;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes)
      if (axis.translation) translations.insert(axis.coordinate);
  std::vector<Problem> problems;
  for (std::size_t column = 0; column < motion.coordinates.size(); ++column) {
    if (!translations.contains(motion.coordinates[column])) continue;
    for (std::size_t row = 1; row < motion.times.size(); ++row) {
      const auto value = [&](std::size_t at) {
        return motion.values(static_cast<Eigen::Index>(at), static_cast<Eigen::Index>(column));
      };
      const Real jump = std::abs(value(row) - value(row - 1));
      if (jump <= longest_jump) continue;
      char length[32];
      std::snprintf(length, sizeof length, "%.3g", jump);
      problems.push_back({"", "motion '" + motion.name + "'",
                          "the coordinate '" + motion.coordinates[column] + "' jumps by " + length + " m from row " +
                              std::to_string(row - 1) + " to row " + std::to_string(row),
                          "correct the value or its unit; at most 100 m from row to row are followed"});
      break;
    }
  }
  return problems;
}

}  // namespace gracilis
