#include "scene_reader_fixture.hpp"

#include <gmock/gmock.h>

namespace gracilis {

using testing::ElementsAre;
using testing::HasSubstr;

/// Two triangles: one 1 mm above the muscle, on the upper bone, and one below it, on the lower bone.
static const char* const patch =
    "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "-1 -1 30\n4 -1 30\n-1 4 30\n-1 -1 10\n12 -1 10\n-1 12 10\n3 0 1 2\n3 3 4 5\n";

static std::string by_patch(const std::string& bone, const std::string& distance) {
  return with(good_scene(), "bone = \"" + bone + "\"\nbone_distance_mm = 2",
              "bone = \"" + bone + "\"\npatch = \"patch.ply\"\nunit = \"mm\"\nlandmark_distance_mm = " + distance);
}

TEST_F(SceneReader, a_patch_holds_what_is_near_its_pieces_on_the_attachment_s_bone) {
  folder.write("patch.ply", patch);
  EXPECT_THAT(read(by_patch("pelvis", "2")).scene.muscles[0].attachments[0].vertices, ElementsAre(4));
  EXPECT_THAT(read(by_patch("femur", "2")).scene.muscles[0].attachments[1].vertices, ElementsAre(0, 1, 2));
  const std::string with_bone = with(by_patch("pelvis", "8"), "patch =", "bone_distance_mm = 2\npatch =");
  EXPECT_THAT(read(with_bone).scene.muscles[0].attachments[0].vertices, ElementsAre(4, 5, 6));
}

TEST_F(SceneReader, a_patch_without_distance_or_beside_landmarks_is_refused) {
  folder.write("patch.ply", patch);
  EXPECT_THAT(problems(with(by_patch("pelvis", "2"), "landmark_distance_mm = 2", "")),
              HasSubstr("landmark_distance_mm"));
  EXPECT_THAT(problems(with(by_patch("pelvis", "2"), "patch =", "points_mm = [[0, 0, 30]]\npatch =")),
              HasSubstr("both a patch and landmarks"));
  EXPECT_THAT(problems(by_patch("pelvis", "0.5")), HasSubstr("holds no vertex"));
  EXPECT_THAT(problems(with(by_patch("pelvis", "2"), "patch.ply", "nowhere.ply")), HasSubstr("does not exist"));
}

TEST_F(SceneReader, a_surface_may_be_taken_into_the_other_half_of_the_body) {
  // The subject looks along x and stands along z, so that y is left.
  const std::string axes = "schema = 1\nanterior = [1, 0, 0]\nsuperior = [0, 0, 1]\n";
  const std::string text = with(good_scene(), "schema = 1\n", axes);
  const TriangleMesh before = read(text).scene.bones[0].surface;
  const TriangleMesh after =
      read(with(text, "file = \"pelvis.ply\"", "file = \"pelvis.ply\"\nmirror = true")).scene.bones[0].surface;
  EXPECT_EQ(after.vertices.row(0), before.vertices.row(0));
  EXPECT_EQ(after.vertices.row(1), -before.vertices.row(1));
  EXPECT_EQ(after.vertices.row(2), before.vertices.row(2));
}

TEST_F(SceneReader, what_was_guessed_is_kept_for_the_manifest) {
  const std::string text = with(good_scene(), "schema = 1\n", "schema = 1\nguessed = [\"joint hip: a sphere\"]\n");
  EXPECT_THAT(read(text).guessed, ElementsAre("joint hip: a sphere"));
}

}  // namespace gracilis
