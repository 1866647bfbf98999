#include <gracilis/anatomy/resolution/coarser_muscle.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/topology.hpp>

#include <shaped_hip.hpp>

#include <gtest/gtest.h>

namespace gracilis {

TEST(CoarserMuscle, has_edges_of_the_length_asked_for_and_keeps_shape_and_attachments) {
  for (const Muscle& whole : shaped_hip().muscles) {
    const CoarserMuscle coarser = coarser_muscle(whole, 0.008);
    const TriangleMesh& surface = coarser.muscle.surface;
    EXPECT_TRUE(is_closed(surface.faces)) << whole.name;
    Real sum = 0;
    const MeshTopology topology = build_topology(surface.faces, surface.vertex_count());
    for (const MeshEdge& edge : topology.edges)
      sum += (surface.vertices.col(edge.a) - surface.vertices.col(edge.b)).norm();
    EXPECT_NEAR(sum / static_cast<Real>(topology.edges.size()), 0.008, 0.003) << whole.name;
    EXPECT_NEAR(
        enclosed_volume(surface.vertices, surface.faces) / enclosed_volume(whole.surface.vertices, whole.surface.faces),
        1, 0.05)
        << whole.name;
    ASSERT_EQ(coarser.muscle.attachments.size(), whole.attachments.size());
    for (std::size_t i = 0; i < whole.attachments.size(); ++i) {
      const std::vector<Index>& all = whole.attachments[i].vertices;
      EXPECT_FALSE(coarser.muscle.attachments[i].vertices.empty()) << whole.name;
      for (const Index v : coarser.muscle.attachments[i].vertices)
        EXPECT_TRUE(std::binary_search(all.begin(), all.end(), coarser.vertices[static_cast<std::size_t>(v)]));
    }
  }
}

TEST(CoarserMuscle, without_an_edge_length_is_the_muscle_itself) {
  const Muscle whole = shaped_hip().muscles.front();
  const CoarserMuscle same = coarser_muscle(whole, 0);
  EXPECT_EQ(same.muscle.surface.faces, whole.surface.faces);
  EXPECT_EQ(same.muscle.surface.vertices, whole.surface.vertices);
}

}  // namespace gracilis
