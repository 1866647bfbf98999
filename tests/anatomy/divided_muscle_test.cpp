#include <gracilis/anatomy/resolution/divided_muscle.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

namespace gracilis {

TEST(DividedMuscle, only_surfaces_of_needles_are_divided) {
  std::vector<Muscle> muscles(3);
  muscles[0].surface = shapes::sphere(Vec3::Zero(), 0.02, 3);
  muscles[1].surface = shapes::cylinder(0.01, 0.2, 60, 2);
  const TriangleMesh ball = muscles[0].surface;
  const Index count = muscles[1].surface.vertex_count();
  const std::vector<VerticesBetween> added = divide_needles(muscles);
  EXPECT_TRUE(added[0].ends.empty());
  EXPECT_EQ(muscles[0].surface.faces, ball.faces);
  EXPECT_EQ(added[1].first, count);
  EXPECT_FALSE(added[1].ends.empty());
  EXPECT_EQ(muscles[1].surface.vertex_count(), count + static_cast<Index>(added[1].ends.size()));
  EXPECT_TRUE(added[2].ends.empty()) << "a muscle without a surface";
}

TEST(DividedMuscle, surfaces_of_sections_stay) {
  std::vector<Muscle> muscles(1);
  muscles[0].surface = shapes::cylinder(0.01, 0.2, 60, 2);
  muscles[0].action_line.rays = 60;
  const Index count = muscles[0].surface.vertex_count();
  EXPECT_TRUE(divide_needles(muscles)[0].ends.empty());
  EXPECT_EQ(muscles[0].surface.vertex_count(), count);
}

TEST(DividedMuscle, what_lies_between_listed_vertices_is_added_to_them) {
  const VerticesBetween added{4, {{0, 1}, {4, 1}, {2, 3}, {5, 4}}};
  std::vector<Index> vertices = {0, 1, 2};
  add_vertices_between(added, vertices);
  EXPECT_EQ(vertices, (std::vector<Index>{0, 1, 2, 4, 5, 7}));
}

}  // namespace gracilis
