#include <gracilis/anatomy/resolution/finer_muscle.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <set>

namespace gracilis {
namespace {

Muscle ball_muscle() {
  Muscle muscle;
  muscle.surface = shapes::sphere(Vec3::Zero(), 0.01, 2);
  Attachment attachment;
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v)
    if (muscle.surface.vertices(2, v) > 0.005) attachment.vertices.push_back(v);
  muscle.attachments = {attachment};
  return muscle;
}

}  // namespace

TEST(FinerMuscle, has_four_triangles_for_each_and_the_same_volume) {
  const Muscle muscle = ball_muscle(), finer = finer_muscle(muscle);
  EXPECT_EQ(finer.surface.face_count(), 4 * muscle.surface.face_count());
  EXPECT_EQ(finer.surface.vertex_count(), 2 + finer.surface.face_count() / 2) << "of a closed ball";
  EXPECT_NEAR(enclosed_volume(finer.surface.vertices, finer.surface.faces),
              enclosed_volume(muscle.surface.vertices, muscle.surface.faces), 1e-15);
}

TEST(FinerMuscle, is_closed_and_faces_outwards) {
  const MeshTopology topology =
      build_topology(finer_muscle(ball_muscle()).surface.faces, finer_muscle(ball_muscle()).surface.vertex_count());
  for (const MeshEdge& edge : topology.edges) {
    EXPECT_GE(edge.left, 0);
    EXPECT_GE(edge.right, 0);
  }
}

TEST(FinerMuscle, is_attached_where_it_was) {
  const Muscle muscle = ball_muscle(), finer = finer_muscle(muscle);
  const std::vector<Index>&before = muscle.attachments[0].vertices, &after = finer.attachments[0].vertices;
  EXPECT_GT(after.size(), 2 * before.size());
  EXPECT_TRUE(std::is_sorted(after.begin(), after.end()));
  EXPECT_EQ(std::set<Index>(after.begin(), after.end()).size(), after.size());
  for (const Index v : before) EXPECT_TRUE(std::binary_search(after.begin(), after.end(), v));
  Real lowest = 1;
  for (const Index v : before) lowest = std::min(lowest, muscle.surface.vertices(2, v));
  for (const Index v : after) EXPECT_GE(finer.surface.vertices(2, v), lowest - 1e-12);
}

}  // namespace gracilis
