#include <gracilis/view/pictures/drawn_together.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

namespace gracilis {

TEST(DrawnTogether, surfaces_become_one_in_which_each_keeps_its_shape_and_colors) {
  const TriangleMesh small = shapes::sphere(Vec3::Zero(), 0.01, 1), large = shapes::sphere(Vec3::UnitX(), 0.02, 2);
  PaintedSurface plain{"a", small, Color(0.1, 0.2, 0.3)}, painted{"b", large};
  painted.colors = Points::Random(3, large.vertex_count());
  const std::vector<PaintedSurface> drawn = drawn_together({plain, painted});
  ASSERT_EQ(drawn.size(), 1u);
  const Index count = small.vertex_count();
  EXPECT_EQ(drawn[0].mesh.vertices.leftCols(count), small.vertices);
  EXPECT_EQ(drawn[0].mesh.vertices.rightCols(large.vertex_count()), large.vertices);
  EXPECT_EQ(drawn[0].mesh.faces.leftCols(small.face_count()), small.faces);
  EXPECT_EQ(Eigen::Matrix3Xi(drawn[0].mesh.faces.rightCols(large.face_count()).array() - count), large.faces);
  EXPECT_EQ(Color(drawn[0].colors.col(count - 1)), plain.color);
  EXPECT_EQ(drawn[0].colors.rightCols(large.vertex_count()), painted.colors);
}

TEST(DrawnTogether, what_is_seen_through_striped_or_open_stays_apart) {
  const TriangleMesh mesh = shapes::sphere(Vec3::Zero(), 0.01, 1);
  PaintedSurface plain{"", mesh}, clear = plain, striped = plain, closed = plain;
  clear.opacity = 0.3;
  striped.stripes.assign(static_cast<std::size_t>(mesh.vertex_count()), 0.5);
  closed.solid = true;
  const std::vector<PaintedSurface> drawn = drawn_together({plain, clear, striped, closed, clear, striped});
  ASSERT_EQ(drawn.size(), 4u);
  for (const PaintedSurface& each : drawn) {
    const Index copies = each.opacity < 1 || !each.stripes.empty() ? 2 : 1;
    EXPECT_EQ(each.mesh.face_count(), copies * mesh.face_count());
    EXPECT_TRUE(each.stripes.empty() || static_cast<Index>(each.stripes.size()) == each.mesh.vertex_count());
  }
}

}  // namespace gracilis
