#include <gracilis/io/landmarks.hpp>
#include <gracilis/io/scene_inputs.hpp>
#include <gracilis/io/table.hpp>

namespace gracilis {

std::map<std::string, Points> read_scene_landmarks(const std::filesystem::path& path, Real unit) {
  std::map<std::string, Points> clouds;
  for (const LandmarkCloud& cloud : read_landmarks(path, unit)) clouds[cloud.name] = cloud.points;
  return clouds;
}

Motion read_scene_motion(const std::filesystem::path& path, std::vector<std::string>& warnings) {
  const Table table = read_table(path);
  warnings.insert(warnings.end(), table.warnings.begin(), table.warnings.end());
  return motion_from_table(table);
}

}  // namespace gracilis
