#include <gracilis/simulate/attachment_zone.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/nearest_points.hpp>

namespace gracilis {

std::vector<char> near_attachments(const Points& rest, const std::vector<Index>& attached) {
  std::vector<char> near(static_cast<std::size_t>(rest.cols()), 0);
  if (attached.empty()) return near;
  const Points places = rest(Eigen::all, attached);
  const NearestPoints nearest(places);
  parallel_for(static_cast<Index>(rest.cols()), 256, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v)
      near[static_cast<std::size_t>(v)] =
          (rest.col(v) - places.col(nearest.nearest(rest.col(v)))).norm() <= attachment_zone;
  });
  return near;
}

}  // namespace gracilis
