#include <gracilis/dynamics/face_fans.hpp>

#include <numeric>

namespace gracilis {

FaceFans build_face_fans(const Eigen::Matrix3Xi& faces, Index particle_count) {
  FaceFans fans;
  fans.offsets.assign(static_cast<std::size_t>(particle_count) + 1, 0);
  for (const Index corner : faces.reshaped()) ++fans.offsets[static_cast<std::size_t>(corner) + 1];
  std::partial_sum(fans.offsets.begin(), fans.offsets.end(), fans.offsets.begin());
  fans.faces.resize(static_cast<std::size_t>(faces.size()));
  fans.ends.resize(2, faces.size());
  std::vector<Index> next(fans.offsets.begin(), fans.offsets.end() - 1);
  for (Index f = 0; f < faces.cols(); ++f)
    for (int corner = 0; corner < 3; ++corner) {
      const Index at = next[static_cast<std::size_t>(faces(corner, f))]++;
      fans.faces[static_cast<std::size_t>(at)] = f;
      fans.ends.col(at) << faces((corner + 1) % 3, f), faces((corner + 2) % 3, f);
    }
  return fans;
}

}  // namespace gracilis
