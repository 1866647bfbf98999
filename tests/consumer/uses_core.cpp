// Asks the distance field of a ball, meshed here, for a point inside and one outside.
#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/geometry/implicit_surface.hpp>
#include <gracilis/geometry/surface_extraction.hpp>

#include <cmath>
#include <cstdio>

int main() {
  using namespace gracilis;
  constexpr Real radius = 0.02;
  const TriangleMesh ball_surface = mesh_solid(ball(Vec3::Zero(), radius), 0.001, 0.002);
  const DistanceField field = build_distance_field(ball_surface, domain_by_cell_size(ball_surface, 0.001, 0.01));
  Points points(3, 2);
  points.col(0) = Vec3(0.015, 0, 0);
  points.col(1) = Vec3(0, 0.025, 0);
  Eigen::VectorXd distances;
  sample(field, points, distances);
  std::printf("%d triangles; distances %.4f and %.4f m\n", ball_surface.face_count(), distances[0], distances[1]);
  return std::abs(distances[0] + 0.005) < 2e-4 && std::abs(distances[1] - 0.005) < 2e-4 ? 0 : 1;
}
