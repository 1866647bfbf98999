#include <gracilis/dynamics/contact/field/face_set.hpp>

#include <gracilis/dynamics/coloring.hpp>

#include <algorithm>

namespace gracilis {

FaceSet build_face_set(const Eigen::Matrix3Xi& faces, Index particle_count) {
  ConstraintGraph graph{3, particle_count, {faces.data(), faces.data() + faces.size()}};
  const std::vector<Index> colors = color_constraints(graph);
  FaceSet set;
  const Index color_count = colors.empty() ? 0 : *std::max_element(colors.begin(), colors.end()) + 1;
  for (Index color = 0; color < color_count; ++color) {
    const Index begin = set.count();
    for (Index f = 0; f < faces.cols(); ++f)
      for (int k = 0; k < 3 && colors[static_cast<std::size_t>(f)] == color; ++k)
        set.particles[static_cast<std::size_t>(k)].push_back(faces(k, f));
    set.colors.push_back({begin, set.count()});
  }
  return set;
}

}  // namespace gracilis
