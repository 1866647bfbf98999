#include <gracilis/dynamics/constraints/distance.hpp>
#include <gracilis/dynamics/particle_order.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <numeric>

namespace gracilis {
namespace {

/// Share of a surface's edges whose ends are in one cluster when its particles stand in this order.
Real share_inside(const MeshTopology& topology, const std::vector<Index>& order) {
  const auto count = static_cast<Index>(order.size()), clusters = cluster_count_of(count);
  std::vector<Index> cluster(order.size());
  for (Index p = 0; p < count; ++p)
    cluster[static_cast<std::size_t>(order[static_cast<std::size_t>(p)])] = cluster_of(p, count, clusters);
  Index inside = 0;
  for (const MeshEdge& edge : topology.edges)
    inside += cluster[static_cast<std::size_t>(edge.a)] == cluster[static_cast<std::size_t>(edge.b)];
  return static_cast<Real>(inside) / static_cast<Real>(topology.edges.size());
}

void expect_permutation(std::vector<Index> order) {
  std::vector<Index> expected(order.size());
  std::iota(expected.begin(), expected.end(), 0);
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, expected);
}

}  // namespace

TEST(ParticleOrder, of_a_small_surface_is_breadth_first) {
  const TriangleMesh mesh = shapes::sphere(Vec3::Zero(), 0.05, 5);
  const MeshTopology topology = build_topology(mesh.faces, mesh.vertex_count());
  EXPECT_EQ(particle_order(mesh.vertices, topology.stars), breadth_first_order(topology.stars));
}

TEST(ParticleOrder, of_a_large_surface_leaves_nine_in_ten_edges_within_a_cluster) {
  const TriangleMesh mesh = shapes::cylinder(0.02, 0.1, 400, 200);
  const MeshTopology topology = build_topology(mesh.faces, mesh.vertex_count());
  const std::vector<Index> order = particle_order(mesh.vertices, topology.stars);
  ASSERT_GT(cluster_count_of(static_cast<Index>(order.size())), 30);
  expect_permutation(order);
  EXPECT_GT(share_inside(topology, order), 0.9);
  EXPECT_LT(share_inside(topology, breadth_first_order(topology.stars)), 0.9);
}

TEST(ParticleOrder, clusters_hold_ranges_of_numbers_that_differ_by_one_at_most) {
  for (const Index count : {1, 2048, 5000, 100003}) {
    const Index clusters = cluster_count_of(count);
    std::vector<Index> sizes(static_cast<std::size_t>(clusters), 0);
    Index last = 0;
    for (Index p = 0; p < count; ++p) {
      const Index cluster = cluster_of(p, count, clusters);
      EXPECT_GE(cluster, last);
      ++sizes[static_cast<std::size_t>(last = cluster)];
    }
    EXPECT_LE(*std::max_element(sizes.begin(), sizes.end()) - *std::min_element(sizes.begin(), sizes.end()), 1);
  }
}

}  // namespace gracilis
