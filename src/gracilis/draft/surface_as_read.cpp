#include <gracilis/draft/surface_as_read.hpp>

#include <gracilis/anatomy/attachments/attachments.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gracilis {

SurfaceAsRead::SurfaceAsRead(const TriangleMesh& of_file) {
  std::vector<Muscle> muscles(1);
  muscles.front().surface = of_file;
  added = divide_needles(muscles).front();
  mesh = std::move(muscles.front().surface);
}

Points SurfaceAsRead::places(std::vector<Index> vertices) const {
  add_vertices_between(added, vertices);
  return mesh.vertices(Eigen::all, vertices);
}

Real SurfaceAsRead::reach_of(const Points& places, Real most) const {
  constexpr Real written = 2e-6;  // m: tables have three decimals of a millimetre
  const auto names_others = [&](Real reach) {
    return static_cast<Index>(select_vertices(mesh, {}, NearPoints{{{places, LineKind::cloud}}, reach}).size()) >
           places.cols();
  };
  Real reach = most;
  while (reach / 2 > written && names_others(reach)) reach /= 2;
  return reach;
}

Real distance_to_all(const Points& points, std::span<const NearestTriangle* const> surfaces, Real least) {
  Real most = 0;
  for (const auto& point : points.colwise()) {
    Real nearest = std::numeric_limits<Real>::infinity();
    for (const NearestTriangle* surface : surfaces) nearest = std::min(nearest, surface->query(point).distance);
    most = std::max(most, nearest);
  }
  constexpr Real step = 0.0001;
  return most <= least ? least : std::ceil(most / step) * step;
}

}  // namespace gracilis
