#include "io/scene_reader_fixture.hpp"

#include <gmock/gmock.h>

namespace gracilis {

static std::string with_transversal(const std::string& lines) {
  return good_scene() + "[[transversals]]\nmuscle = \"muscle\"\n" + lines;
}

TEST_F(SceneReader, a_transversal_says_where_on_both_muscles) {
  EXPECT_THAT(problems(with_transversal("ray = 1\nbones = [\"pelvis\"]\n")),
              testing::HasSubstr("needs the key 'section'"));
  EXPECT_THAT(problems(with_transversal("section = 1\nbones = [\"pelvis\"]\n")),
              testing::HasSubstr("needs the key 'ray'"));
  const std::string other = problems(with_transversal("section = 1\nray = 2\nother_muscle = \"muscle\"\n"));
  EXPECT_THAT(other, testing::HasSubstr("needs the key 'other_section'"));
  EXPECT_THAT(other, testing::HasSubstr("needs the key 'other_ray'"));
  EXPECT_THAT(problems(with_transversal("section = 1\nray = 2\n")), testing::HasSubstr("keeps out of nothing"));
  EXPECT_THAT(problems(with_transversal("section = 1\nray = 2\nbones = [\"pelvis\"]\nother_ray = 1\n")),
              testing::HasSubstr("give 'other_muscle'"));
}

}  // namespace gracilis
