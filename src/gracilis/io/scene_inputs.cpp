#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/scene_inputs.hpp>

#include <sstream>
#include <vector>

namespace gracilis {

std::map<std::string, Points> read_scene_landmarks(const std::filesystem::path& path, Real unit) {
  std::istringstream text(read_text(path));
  std::map<std::string, std::vector<Vec3>> clouds;
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line)) {
    std::istringstream row(line);
    std::string cloud, index, x, y, z;
    std::getline(row, cloud, ',');
    std::getline(row, index, ',');
    std::getline(row, x, ',');
    std::getline(row, y, ',');
    std::getline(row, z, ',');
    clouds[cloud].push_back(Vec3(std::stod(x), std::stod(y), std::stod(z)) * unit);
  }
  std::map<std::string, Points> result;
  for (const auto& [name, points] : clouds) {
    Points& columns = result[name];
    columns.resize(3, static_cast<Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) columns.col(i) = points[i];
  }
  return result;
}

Motion read_scene_motion(const std::filesystem::path& path) {
  throw InputError({path.string(), "", "motion tables cannot be read yet", "use 'key_poses_deg'"});
}

}  // namespace gracilis
