#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/tissue/seen_apart.hpp>

#include "held_tubes.hpp"

#include <gtest/gtest.h>

/// What is seen of two muscles where it lies deep in each other.
namespace gracilis {
namespace {

using namespace tissue;

/// Two tubes at rest, 1 mm apart, of the first of which one vertex is seen so deep (m) in the second, where both were
/// last looked at.
struct DrawnTubes {
  Scene scene;
  TissueMuscles tissues;
  std::vector<MovingMuscle> moving;
  std::vector<Points> before;
  Index drawn = 0;

  explicit DrawnTubes(Real deep, bool is_held = false) : scene(held_tubes_across(0.001, 40)) {
    (scene.muscles[0].surface.vertices.colwise() - Vec3(0.01, 0, 0)).colwise().squaredNorm().minCoeff(&drawn);
    if (is_held) scene.muscles[0].attachments[0].vertices.push_back(drawn);
    tissues = prepare_tissues(scene, {}, {});
    const std::vector<RigidTransform> bodies(scene.bodies.size(), RigidTransform::Identity());
    for (std::size_t m = 0; m < 2; ++m) {
      before.push_back(scene.muscles[m].surface.vertices);
      moving.emplace_back();
      moving[m].nodes = tissues.muscles[m].lattice.nodes;
      moving[m].equilibrium.around = surroundings(tissues.muscles[m], bodies, cell_laws(tissues.muscles[m], 0, 1));
    }
    before[0](0, drawn) += 0.001 + deep;
    for (std::size_t m = 0; m < 2; ++m) moving[m].seen = before[m];
    contact_planes(tissues.neighbors, before);
  }
  void part(Real moved = 0) { keep_seen_apart(tissues, {}, moved, moving); }
  Real depth_of_drawn() const {
    return depth(moving[0].seen.col(drawn), moving[1].seen, scene.muscles[1].surface.faces);
  }
  Real volume_ratio(std::size_t m) const {
    const Eigen::Matrix3Xi& faces = scene.muscles[m].surface.faces;
    return enclosed_volume(moving[m].seen, faces) / enclosed_volume(before[m], faces);
  }
  bool stays(std::size_t m) const { return moving[m].seen == before[m]; }
};

TEST(TissueSeenApart, a_vertex_seen_deep_in_another_muscle_comes_out_by_both_of_them) {
  DrawnTubes tubes(0.002);
  ASSERT_GT(tubes.depth_of_drawn(), 0.0015);
  tubes.part();
  EXPECT_LT(tubes.depth_of_drawn(), 5e-4);
  EXPECT_NEAR(tubes.before[0](0, tubes.drawn) - tubes.moving[0].seen(0, tubes.drawn), 0.001, 2e-4);
  EXPECT_GT((tubes.moving[1].seen - tubes.before[1]).colwise().norm().maxCoeff(), 8e-4);
}

TEST(TissueSeenApart, volumes_tissue_and_what_is_held_stay) {
  DrawnTubes tubes(0.002);
  tubes.part();
  for (std::size_t m = 0; m < 2; ++m) {
    EXPECT_NEAR(tubes.volume_ratio(m), 1, 1e-5);
    EXPECT_EQ(tubes.moving[m].nodes, tubes.tissues.muscles[m].lattice.nodes);
    for (const Attachment& attachment : tubes.scene.muscles[m].attachments)
      for (const Index v : attachment.vertices) EXPECT_EQ(tubes.moving[m].seen.col(v), tubes.before[m].col(v));
  }
}

TEST(TissueSeenApart, nothing_moves_where_nothing_lies_deep) {
  DrawnTubes tubes(0.0003);
  tubes.part();
  EXPECT_TRUE(tubes.stays(0) && tubes.stays(1));
}

TEST(TissueSeenApart, a_vertex_that_a_bone_holds_stays_where_that_takes_it) {
  DrawnTubes tubes(0.002, true);
  tubes.part();
  EXPECT_EQ(tubes.moving[0].seen.col(tubes.drawn), tubes.before[0].col(tubes.drawn));
}

TEST(TissueSeenApart, what_came_deeper_since_muscles_looked_comes_out_too) {
  DrawnTubes tubes(0.001);
  tubes.moving[0].seen(0, tubes.drawn) += 0.001;
  tubes.part(0.001);
  EXPECT_LT(tubes.depth_of_drawn(), 5e-4);
}

TEST(TissueSeenApart, muscles_that_lie_in_each_other_at_rest_may_stay_as_deep) {
  Scene scene = held_tubes_across(-0.002, 40);
  TissueMuscles tissues = prepare_tissues(scene, {}, {});
  std::vector<Points> shapes = {scene.muscles[0].surface.vertices, scene.muscles[1].surface.vertices};
  contact_planes(tissues.neighbors, shapes);
  for (const Points& way : ways_apart(tissues.neighbors, shapes, 0.001)) EXPECT_EQ(way.cols(), 0);
  shapes[1].row(0).array() -= 0.001;
  contact_planes(tissues.neighbors, shapes);
  const std::vector<Points> ways = ways_apart(tissues.neighbors, shapes, 0.001);
  ASSERT_EQ(ways[0].cols(), shapes[0].cols());
  EXPECT_NEAR(ways[0].colwise().norm().maxCoeff(), 0.0005, 1e-4);
}

}  // namespace
}  // namespace gracilis
