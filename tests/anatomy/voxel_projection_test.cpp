#include <gracilis/anatomy/overlap/bone_projection.hpp>
#include <gracilis/anatomy/overlap/voxel_projection.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

/// What keeps vertices out of bones: two ways back, by two means.
namespace gracilis {
namespace {

struct Pushed {
  Scene scene = tube_scene();
  Points began = scene.muscles[0].surface.vertices, moved = began, moved_back;
  Pose pose = flexed(scene, 0);
  std::vector<Index> all_free = std::vector<Index>(static_cast<std::size_t>(began.cols()), -1);
  Index vertex = 0;  ///< of the tube, in front of the lower bone

  Pushed() {
    while (!(began(0, vertex) < 0.0165 && began(2, vertex) < -0.03 && began(2, vertex) > -0.06)) ++vertex;
    moved.col(vertex) += Vec3(-0.004, 0, 0.002);
    moved_back = moved;
  }
  void expect_out_along(const Vec3& way) const {
    const Vec3 back = moved_back.col(vertex) - moved.col(vertex);
    EXPECT_NEAR(moved_back(0, vertex), 0.015, 2e-3) << "no farther than a box";
    EXPECT_GT(moved_back(0, vertex), 0.015 - 2e-6);
    EXPECT_LT(back.normalized().cross(way.normalized()).norm(), 1e-3);
    EXPECT_GT(back.dot(way), 0);
    for (Index v = 0; v < static_cast<Index>(began.cols()); ++v) {
      if (v != vertex) {
        EXPECT_EQ(moved_back.col(v), began.col(v));
      }
    }
  }
};

TEST(BoneProjection, a_vertex_goes_the_shortest_way_out_or_back_as_it_came) {
  Pushed out, back;
  const BoneProjection bones(out.scene, out.scene.muscles[0], out.all_free, tube_fields(), 0, false);
  EXPECT_EQ(bones.push_out(out.pose, out.moved_back), 1);
  out.expect_out_along(Vec3::UnitX());
  EXPECT_EQ(bones.take_back(back.pose, back.began, back.moved_back), 1);
  back.expect_out_along(Vec3(0.004, 0, -0.002));
}

TEST(VoxelProjection, a_vertex_goes_the_shortest_way_out_or_back_as_it_came) {
  Pushed out, back;
  const VoxelProjection bones(out.scene, out.scene.muscles[0], out.all_free, bone_voxels(out.scene, 64), false);
  EXPECT_EQ(bones.push_out(out.pose, out.moved_back), 1);
  out.expect_out_along(Vec3::UnitX());
  EXPECT_EQ(bones.take_back(back.pose, back.began, back.moved_back), 1);
  back.expect_out_along(Vec3(0.004, 0, -0.002));
}

TEST(BoneProjection, what_began_in_a_bone_ends_where_it_began) {
  Pushed pushed;
  pushed.began.col(pushed.vertex).x() = 0.01;
  const BoneProjection fields(pushed.scene, pushed.scene.muscles[0], pushed.all_free, tube_fields(), 0, false);
  const VoxelProjection voxels(pushed.scene, pushed.scene.muscles[0], pushed.all_free, bone_voxels(pushed.scene, 64),
                               false);
  Points by_fields = pushed.moved, by_voxels = pushed.moved;
  EXPECT_EQ(fields.take_back(pushed.pose, pushed.began, by_fields), 1);
  EXPECT_EQ(voxels.take_back(pushed.pose, pushed.began, by_voxels), 1);
  EXPECT_EQ(by_fields.col(pushed.vertex), pushed.began.col(pushed.vertex));
  EXPECT_LT((by_voxels.col(pushed.vertex) - pushed.began.col(pushed.vertex)).norm(), 1e-15);
}

TEST(VoxelProjection, with_rest_gaps_a_bone_leaves_alone_what_was_in_its_boxes) {
  Pushed pushed;
  pushed.scene.muscles[0].surface.vertices.col(pushed.vertex).x() = 0.01;
  Points points = pushed.moved;
  const VoxelProjection bones(pushed.scene, pushed.scene.muscles[0], pushed.all_free, bone_voxels(pushed.scene, 64),
                              true);
  EXPECT_EQ(bones.push_out(pushed.pose, points), 0);
}

TEST(VoxelProjection, attached_vertices_are_left_alone) {
  Pushed pushed;
  std::vector<Index> fixed(pushed.all_free.size(), 1);
  const VoxelProjection bones(pushed.scene, pushed.scene.muscles[0], fixed, bone_voxels(pushed.scene, 64), false);
  EXPECT_EQ(bones.push_out(pushed.pose, pushed.moved_back), 0);
}

}  // namespace
}  // namespace gracilis
