#include "scene_reader_fixture.hpp"

#include <gmock/gmock.h>

namespace gracilis {

using testing::ElementsAre;
using testing::HasSubstr;

/// The scene with a second muscle, before the first, whose insertion lies on that; `where` says which vertices.
static std::string with_rider(const std::string& where = "muscle_distance_mm = 0.3\n",
                              const std::string& on = "muscle") {
  const std::string scene = good_scene();
  const std::size_t first = scene.find("[[muscles]]"), next = scene.find("\n[", scene.find("insertion", first));
  std::string rider = scene.substr(first, next == std::string::npos ? next : next - first);
  const auto replace = [&rider](const std::string& old, const std::string& by) { rider = with(rider, old, by); };
  replace("name = \"muscle\"", "name = \"rider\"");
  replace("muscle.ply", "rider.ply");
  replace("bone = \"femur\"\nbone_distance_mm = 2", "muscle = \"" + on + "\"\n" + where);
  return scene.substr(0, first) + rider + "\n" + scene.substr(first);
}

/// A muscle between the pelvis and the middle of the other.
class EndOnMuscleScene : public SceneReader {
 protected:
  EndOnMuscleScene() { folder.write_box("rider.ply", 20, 29.5); }
};

TEST_F(EndOnMuscleScene, it_gets_a_body_that_the_muscle_carries) {
  const Scene scene = read(with_rider()).scene;
  ASSERT_EQ(scene.muscle_bodies.size(), 1u);
  const MuscleBody& body = scene.muscle_bodies[0];
  EXPECT_EQ(scene.muscles[0].attachments[1].body, body.body);
  EXPECT_THAT(scene.muscles[0].attachments[1].vertices, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(scene.bodies[static_cast<std::size_t>(body.body)], "rider_on_muscle");
  EXPECT_EQ(scene.muscles[static_cast<std::size_t>(body.muscle)].name, "muscle");
  EXPECT_EQ(body.bodies.size(), 2u);
}

TEST_F(EndOnMuscleScene, it_may_list_its_vertices) {
  EXPECT_THAT(read(with_rider("vertices = [0, 2]\n")).scene.muscles[0].attachments[1].vertices, ElementsAre(0, 2));
}

TEST_F(EndOnMuscleScene, what_cannot_be_is_refused) {
  EXPECT_THAT(problems(with_rider("muscle_distance_mm = 0.3\n", "muscel")), HasSubstr("there is no muscle 'muscel'"));
  EXPECT_THAT(problems(with_rider("muscle_distance_mm = 0.3\n", "rider")),
              HasSubstr("lies on a muscle that lies on it"));
  EXPECT_THAT(problems(with_rider("")), HasSubstr("needs the key 'muscle_distance_mm'"));
  EXPECT_THAT(problems(with_rider("bone = \"femur\"\nmuscle_distance_mm = 0.3\n")),
              HasSubstr("on a muscle and also on a bone"));
  SceneOptions only;
  only.only = {"rider"};
  EXPECT_THAT(problems(with_rider(), only), HasSubstr("rider lies on muscle, which is left out"));
}

}  // namespace gracilis
