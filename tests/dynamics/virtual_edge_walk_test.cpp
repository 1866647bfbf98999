#include <gracilis/dynamics/havlicek_2024/virtual_edges.hpp>
#include <gracilis/geometry/topology.hpp>

#include <shapes.hpp>

#include "strips.hpp"

#include "millimeter.hpp"

#include <gtest/gtest.h>

namespace gracilis {
namespace {

using Eigen::Vector3f;

/// A surface by its particles and their neighbors.
struct Surface {
  VertexStars stars;
  Particles particles;
};

Surface surface_of(const TriangleMesh& mesh, Real inverse_mass = 1) {
  return {build_topology(mesh.faces, mesh.vertex_count()).stars,
          make_particles(mesh.vertices, Eigen::VectorXd::Constant(mesh.vertex_count(), inverse_mass))};
}

/// A plane of so many squares of 1 mm in each direction.
TriangleMesh grid(int squares) {
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> faces;
  const int width = squares + 1;
  for (int j = 0; j < width; ++j)
    for (int i = 0; i < width; ++i) vertices.emplace_back(0.001 * i, 0.001 * j, 0);
  for (int j = 0; j < squares; ++j)
    for (int i = 0; i < squares; ++i) {
      const int at = j * width + i;
      faces.insert(faces.end(), {{at, at + 1, at + width}, {at + 1, at + width + 1, at + width}});
    }
  return shapes::mesh_of(vertices, faces);
}

EdgeWalk walk(VirtualEdge edge, const Surface& first, const Surface& second, float distance, int most_steps = 100,
              const Vector3f& shift = Vector3f::Zero()) {
  return walk_virtual_edge(edge, first.stars, first.particles, second.stars, second.particles, shift, distance,
                           most_steps);
}

}  // namespace

TEST(VirtualEdgeWalk, goes_along_a_strip_column_by_column_and_ends_where_none_is_nearer) {
  const Surface band = surface_of(straight_strip(11)), spike = surface_of(tetrahedron({0.01, 0, 0.001}));
  const EdgeWalk found = walk({0, 0}, band, spike, 0.5f * mm);
  EXPECT_EQ(found.end, (VirtualEdge{20, 0}));
  EXPECT_FALSE(found.near);
  EXPECT_EQ(found.steps, 11) << "ten columns, and one step that finds nothing nearer";
}

TEST(VirtualEdgeWalk, both_ends_walk_toward_each_other) {
  const Surface low = surface_of(straight_strip(11)), high = surface_of(straight_strip(11, 0.001));
  const EdgeWalk found = walk({0, 20}, low, high, 0.5f * mm);
  EXPECT_EQ(found.end, (VirtualEdge{10, 10}));
  EXPECT_EQ(found.steps, 6);
}

TEST(VirtualEdgeWalk, stops_where_it_is_shorter_than_the_contact_distance) {
  const Surface band = surface_of(straight_strip(11)), spike = surface_of(tetrahedron({0.01, 0, 0.001}));
  // Column 7 is sqrt(3² + 1²) = 3.16 mm from the tip, column 6 is 4.12 mm.
  const EdgeWalk found = walk({0, 0}, band, spike, 3.5f * mm);
  EXPECT_TRUE(found.near);
  EXPECT_EQ(found.end, (VirtualEdge{14, 0}));
  EXPECT_EQ(found.steps, 7);
}

TEST(VirtualEdgeWalk, ends_after_its_last_step_wherever_it_is) {
  const Surface band = surface_of(straight_strip(151)), spike = surface_of(tetrahedron({0.15, 0, 0.001}));
  EXPECT_EQ(walk({0, 0}, band, spike, 0.5f * mm).end, (VirtualEdge{200, 0})) << "100 of 150 columns";
  EXPECT_EQ(walk({0, 0}, band, spike, 0.5f * mm, 4).end, (VirtualEdge{8, 0}));
  EXPECT_EQ(walk({0, 0}, band, spike, 0.5f * mm, 4).steps, 4);
  EXPECT_EQ(walk({0, 0}, band, spike, 0.5f * mm, 1000).end, (VirtualEdge{300, 0}));
}

TEST(VirtualEdgeWalk, is_caught_in_a_local_minimum) {
  // A U whose legs are 10 mm apart: from the tip of the left leg every neighbor is farther from the tip of the right.
  std::vector<Vec3> line;
  for (int i = 0; i <= 20; ++i) line.emplace_back(0, 0, 0.001 * (20 - i));
  for (int i = 1; i <= 10; ++i) line.emplace_back(0.001 * i, 0, 0);
  for (int i = 1; i <= 20; ++i) line.emplace_back(0.01, 0, 0.001 * i);
  const Surface bend = surface_of(strip(line)), spike = surface_of(tetrahedron({0.01, 0, 0.021}));
  const EdgeWalk found = walk({0, 0}, bend, spike, 2 * mm);
  EXPECT_EQ(found.end, (VirtualEdge{0, 0}));
  EXPECT_EQ(found.steps, 1);
  EXPECT_FALSE(found.near);
  EXPECT_TRUE(walk({60, 0}, bend, spike, 2 * mm).near) << "from the right leg it is found";
}

TEST(VirtualEdgeWalk, finds_the_nearest_vertex_of_a_grid_from_every_other) {
  const Surface plane = surface_of(grid(12)), spike = surface_of(tetrahedron({0.0031, 0.0079, 0.001}));
  for (Index start = 0; start < plane.particles.count(); ++start)
    for (Index corner = 0; corner < 4; ++corner)
      EXPECT_EQ(walk({start, corner}, plane, spike, 0.1f * mm).end, (VirtualEdge{8 * 13 + 3, 0})) << start;
}

TEST(VirtualEdgeWalk, takes_the_second_surface_where_the_shift_puts_it) {
  const Surface band = surface_of(straight_strip(11)), spike = surface_of(tetrahedron({0, 0, 0.001}));
  EXPECT_EQ(walk({0, 0}, band, spike, 0.5f * mm).end.a, 0);
  EXPECT_EQ(walk({0, 0}, band, spike, 0.5f * mm, 100, {-4 * mm, 0, 0}).end.a, 8);
}

TEST(VirtualEdgeWalk, stays_where_an_end_has_no_neighbors) {
  const Surface band = surface_of(straight_strip(2)), point = surface_of(shapes::mesh_of({{0.001, 0, 0.001}}, {}));
  EXPECT_EQ(walk({0, 0}, band, point, 0.5f * mm).end, (VirtualEdge{2, 0}));
}

}  // namespace gracilis
