#include <gracilis/anatomy/attachments/attachment_reach.hpp>

#include "muscles_for_tests.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {

/// The tube; its bottom's attachment holds all that is below `height`, 30 mm below the top.
Scene tube_held_below(Real height) {
  Scene scene;
  scene.bodies = {"below", "above"};
  scene.muscles = {tube_muscle()};
  Muscle& muscle = scene.muscles[0];
  muscle.attachments[0].vertices.clear();
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v)
    if (muscle.surface.vertices(2, v) < height) muscle.attachments[0].vertices.push_back(v);
  return scene;
}

std::vector<Pose> top_moves_up_by(Real distance) {
  std::vector<Pose> poses;
  for (int step = 0; step <= 200; ++step) {
    poses.push_back(capture_pose(2));
    poses.back().bodies[1].translation().z() = distance * step / 200;
  }
  return poses;
}

Real highest_held(const Scene& scene) {
  Real highest = 0;
  for (const Index v : scene.muscles[0].attachments[0].vertices)
    highest = std::max(highest, scene.muscles[0].surface.vertices(2, v));
  return highest;
}

TEST(AttachmentReach, an_attachment_lets_go_of_what_another_moves_away_from_by_more_than_the_way_between_them) {
  Scene scene = tube_held_below(0.17);
  const std::size_t before = scene.muscles[0].attachments[0].vertices.size(),
                    top = scene.muscles[0].attachments[1].vertices.size();
  const std::vector<LetGo> let_go = let_go_beyond_reach(scene, top_moves_up_by(0.05));
  // A strip of 0.05 m becomes twice as long.
  EXPECT_NEAR(highest_held(scene), 0.15, 0.2 / 80 + 1e-9);
  ASSERT_EQ(let_go.size(), 1u);
  EXPECT_EQ(let_go[0].attachment, "bottom");
  EXPECT_EQ(let_go[0].other, "top");
  EXPECT_EQ(let_go[0].of, static_cast<Index>(before));
  EXPECT_EQ(before - static_cast<std::size_t>(let_go[0].vertices), scene.muscles[0].attachments[0].vertices.size());
  EXPECT_NEAR(let_go[0].stretch, 0.08 / 0.03, 0.3);
  EXPECT_EQ(scene.muscles[0].attachments[1].vertices.size(), top);
}

TEST(AttachmentReach, what_is_out_of_reach_in_the_middle_of_a_motion_is_let_go_too) {
  Scene scene = tube_held_below(0.17), there_and_back = tube_held_below(0.17);
  std::vector<Pose> poses = top_moves_up_by(0.05);
  let_go_beyond_reach(scene, poses);
  const std::vector<Pose> back(poses.rbegin(), poses.rend());
  poses.insert(poses.end(), back.begin(), back.end());
  EXPECT_EQ(let_go_beyond_reach(there_and_back, poses).size(), 1u);
  // Some sixty of the 402 poses are asked: the farthest of these is within 2 % of the way.
  EXPECT_NEAR(highest_held(there_and_back), highest_held(scene), 0.2 / 80 + 1e-9);
}

TEST(AttachmentReach, nothing_is_let_go_that_the_surface_can_reach) {
  Scene scene = tube_held_below(0.17);
  EXPECT_TRUE(let_go_beyond_reach(scene, top_moves_up_by(0.025)).empty());
  EXPECT_TRUE(let_go_beyond_reach(scene, {}).empty());
}

TEST(AttachmentReach, of_two_attachments_the_one_that_lists_its_vertices_holds_them) {
  Scene scene = tube_held_below(0.17);
  std::vector<Attachment>& attachments = scene.muscles[0].attachments;
  const std::vector<Index> listed = attachments[0].vertices;
  attachments[0].listed = true;
  let_go_beyond_reach(scene, top_moves_up_by(0.05));
  EXPECT_EQ(attachments[0].vertices, listed);
  attachments[1].listed = true;
  EXPECT_TRUE(let_go_beyond_reach(scene, top_moves_up_by(0.05)).empty());
}

TEST(AttachmentReach, an_attachment_never_lets_go_of_everything) {
  Scene scene = tube_held_below(0.17);
  const std::size_t before = scene.muscles[0].attachments[0].vertices.size();
  EXPECT_TRUE(let_go_beyond_reach(scene, top_moves_up_by(5)).empty());
  EXPECT_EQ(scene.muscles[0].attachments[0].vertices.size(), before);
}

}  // namespace gracilis
