#include <gracilis/geometry/polygon_area.hpp>

#include <gtest/gtest.h>

namespace gracilis {

TEST(PolygonArea, of_a_square_points_to_where_its_corners_go_around) {
  Points square(3, 4);
  square << 0, 2, 2, 0, 0, 0, 2, 2, 5, 5, 5, 5;
  EXPECT_EQ(polygon_area_vector(square), Vec3(0, 0, 4));
  const Points reversed = square.rowwise().reverse();
  EXPECT_EQ(polygon_area_vector(reversed), Vec3(0, 0, -4));
}

TEST(PolygonArea, of_one_with_a_dent_leaves_the_dent_out) {
  Points dented(3, 5);
  dented << 0, 2, 1, 2, 0, 0, 0, 1, 2, 2, 0, 0, 0, 0, 0;
  EXPECT_EQ(polygon_area_vector(dented), Vec3(0, 0, 3));
}

TEST(PolygonArea, of_less_than_three_corners_is_zero) {
  EXPECT_EQ(polygon_area_vector(Points::Ones(3, 1)), Vec3(Vec3::Zero()));
  EXPECT_EQ(polygon_area_vector(Points::Random(3, 2)), Vec3(Vec3::Zero()));
}

}  // namespace gracilis
