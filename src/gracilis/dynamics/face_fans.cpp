#include <gracilis/dynamics/face_fans.hpp>

#include <gracilis/core/group_by_key.hpp>

#include <utility>

namespace gracilis {

FaceFans build_face_fans(const Eigen::Matrix3Xi& faces, Index particle_count) {
  GroupedByKey corners = group_by_key({faces.data(), static_cast<std::size_t>(faces.size())}, particle_count);
  FaceFans fans;
  fans.offsets = std::move(corners.begins);
  fans.faces.reserve(corners.items.size());
  fans.ends.resize(2, faces.size());
  for (const Index corner : corners.items) {
    const Index face = corner / 3, row = corner % 3;
    fans.ends.col(static_cast<Index>(fans.faces.size())) << faces((row + 1) % 3, face), faces((row + 2) % 3, face);
    fans.faces.push_back(face);
  }
  return fans;
}

}  // namespace gracilis
