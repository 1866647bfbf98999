#include <gracilis/view/window/contact_depth.hpp>

#include <gracilis/core/parallel.hpp>

#include <algorithm>
#include <optional>

namespace gracilis {

static constexpr Real reach = 0.003;  // m

ContactDepth::ContactDepth(const std::vector<TriangleMesh>& bones) {
  for (const TriangleMesh& bone : bones) bones_.emplace_back(bone);
}

std::vector<std::vector<float>> ContactDepth::of(const std::vector<TriangleMesh>& muscles,
                                                 const std::vector<std::vector<Index>>& vertices,
                                                 const std::vector<RigidTransform>& moved) const {
  std::vector<std::optional<SignedDistance>> others(muscles.size());
  parallel_for_each(muscles.size(), [&](std::size_t m) { others[m].emplace(muscles[m]); });
  std::vector<RigidTransform> to_rest;
  for (const RigidTransform& motion : moved) to_rest.push_back(motion.inverse());
  const auto depth_at = [&](std::size_t muscle, const Vec3& point) {
    Real gap = reach;
    for (std::size_t b = 0; b < bones_.size(); ++b)
      gap = std::min(gap, bones_[b].query(to_rest[b] * point, reach).distance);
    for (std::size_t m = 0; m < others.size(); ++m)
      if (m != muscle) gap = std::min(gap, others[m]->query(point, reach).distance);
    return static_cast<float>(-gap);
  };
  std::vector<std::vector<float>> depths(muscles.size());
  for (std::size_t m = 0; m < muscles.size(); ++m) {
    depths[m].resize(vertices[m].size());
    parallel_for(static_cast<Index>(vertices[m].size()), 128, [&](Index begin, Index end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
        depths[m][i] = depth_at(m, muscles[m].vertices.col(vertices[m][i]));
    });
  }
  return depths;
}

}  // namespace gracilis
