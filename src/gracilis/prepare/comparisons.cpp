#include <gracilis/prepare/comparisons.hpp>

#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/prepare/cgal.hpp>

#include <algorithm>

namespace gracilis {

SurfaceDistance distance_from_to(const TriangleMesh& from, const TriangleMesh& to) {
  const NearestTriangle nearest(to);
  SurfaceDistance result;
  Index count = 0;
  const auto add = [&](const Vec3& p) {
    const Real distance = nearest.query(p).distance;
    result.largest = std::max(result.largest, distance);
    result.mean += distance;
    ++count;
  };
  for (Index v = 0; v < from.vertex_count(); ++v) add(from.vertices.col(v));
  for (Index f = 0; f < from.face_count(); ++f)
    add((from.vertices.col(from.faces(0, f)) + from.vertices.col(from.faces(1, f)) +
         from.vertices.col(from.faces(2, f))) /
        3);
  result.mean /= count;
  return result;
}

Crossings count_crossings(const std::vector<TriangleMesh>& muscles, const std::vector<TriangleMesh>& bones) {
  std::vector<const TriangleMesh*> all;
  for (const TriangleMesh& mesh : muscles) all.push_back(&mesh);
  for (const TriangleMesh& mesh : bones) all.push_back(&mesh);
  Crossings crossings;
  for (const FacePair& pair : intersecting_faces(all))
    if (pair.mesh_a < static_cast<Index>(muscles.size())) ++crossings[{pair.mesh_a, pair.mesh_b}];
  return crossings;
}

Index crossings_between(const std::vector<TriangleMesh>& muscles, const std::vector<TriangleMesh>& bones) {
  Index sum = 0;
  for (const auto& [pair, count] : count_crossings(muscles, bones))
    if (pair.first != pair.second) sum += count;
  return sum;
}

}  // namespace gracilis
