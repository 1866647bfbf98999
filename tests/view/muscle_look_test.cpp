#include <gracilis/view/pictures/muscle_look.hpp>
#include <gracilis/view/pictures/smooth_lines.hpp>
#include <gracilis/view/pictures/soft_shadows.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gracilis {

/// A tube along z, 160 mm long, thick in the middle: 3 mm in radius at both ends, 15 mm between 50 and 110 mm.
static TriangleMesh belly_with_tendons() {
  TriangleMesh mesh = shapes::cylinder(1, 0.16, 24, 80);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Real off = std::max(std::abs(mesh.vertices(2, v) - 0.08) - 0.03, 0.0);
    mesh.vertices.col(v).head(2) *= 0.015 - 0.012 * std::min(off / 0.02, 1.0);
  }
  mesh.vertices.row(0) *= 1.5;  // wider along x
  return mesh;
}

static MuscleLook look_of(const TriangleMesh& mesh) {
  std::vector<Index> ends[2];
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.vertices(2, v) < 0.001) ends[0].push_back(v);
    if (mesh.vertices(2, v) > 0.159) ends[1].push_back(v);
  }
  return muscle_look(mesh, ends[0], ends[1]);
}

TEST(MuscleLook, is_pale_at_thin_ends_and_red_between) {
  const TriangleMesh mesh = belly_with_tendons();
  const MuscleLook look = look_of(mesh);
  const Points colors = natural_colors(look, "gluteus_maximus_r");
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Real off = std::abs(mesh.vertices(2, v) - 0.08), tendon = look.tendon[static_cast<std::size_t>(v)];
    const Real redness = colors(0, v) / colors(2, v);
    if (off < 0.03) {
      EXPECT_LT(tendon, 0.05) << v;
      EXPECT_GT(redness, 2);
    } else if (off > 0.06) {
      EXPECT_GT(tendon, 0.9) << v;
      EXPECT_LT(redness, 1.2);
    }
  }
}

TEST(MuscleLook, stripes_run_along_the_fibers) {
  // Fibers are the tube's lines: vertices of one angle, 24 numbers apart. All triangles lean to one side, and the
  // field and its gradient a little with them: from the middle to an end a fiber drifts by less than one vertex, by up
  // to three where the tube narrows to a fifth, which itself moves it by four.
  TriangleMesh tube = shapes::cylinder(0.015, 0.16, 24, 80);
  tube.vertices.row(0) *= 1.5;
  const TriangleMesh belly = belly_with_tendons();
  const Points middle = tube.vertices.middleCols(40 * 24, 24);
  const Real one = (middle.col(6) - middle.col(0)).norm() / 6;
  for (const auto& [mesh, drift] : {std::pair<const TriangleMesh*, Real>{&tube, one}, {&belly, 3 * one}}) {
    const MuscleLook look = look_of(*mesh);
    const Real sense = look.stripes[40 * 24] > 0 ? 1 : -1;
    for (Index v = 0; v < 81 * 24; ++v)
      EXPECT_NEAR(sense * look.stripes[static_cast<std::size_t>(v)], middle(0, v % 24), drift) << v;
  }
}

/// The brightness along the middle row of a picture of pixels of 1 mm whose depth is a function of the column.
template <class Depth>
static std::vector<int> shaded(Depth&& depth) {
  constexpr int width = 120, height = 80;
  DepthImage depths{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) depths.depths.push_back(static_cast<float>(depth(x)));
  PixelImage image{width, height, std::vector<unsigned char>(std::size_t{4} * width * height, 200)};
  add_soft_shadows(depths, {0, 0, width, height}, 0.04, image);
  std::vector<int> row;
  for (int x = 0; x < width; ++x) row.push_back(image.rgba[static_cast<std::size_t>(4 * (40 * width + x))]);
  return row;
}

TEST(SoftShadows, darken_valleys_and_neither_slopes_nor_edges) {
  const std::vector<int> slope = shaded([](int x) { return 1 + 0.001 * x; });
  for (std::size_t x = 8; x < 112; ++x) EXPECT_NEAR(slope[x], 200, 1) << x;
  const std::vector<int> valley = shaded([](int x) { return 1 - 0.001 * std::abs(x - 60); });
  EXPECT_LT(valley[60], 160);
  EXPECT_NEAR(valley[30], 200, 1);
  const std::vector<int> ridge = shaded([](int x) { return 1 + 0.001 * std::abs(x - 60); });
  EXPECT_NEAR(ridge[60], 200, 1);
  const std::vector<int> beside_nothing =
      shaded([](int x) { return x < 60 ? 1.0 : std::numeric_limits<double>::infinity(); });
  EXPECT_EQ(beside_nothing[58], 200);
  EXPECT_EQ(beside_nothing[62], 200) << "the background stays as it is";
}

TEST(SmoothLines, keep_their_ends_and_lose_their_corners) {
  Points zigzag(3, 5);
  zigzag << 0, 1, 2, 3, 4, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0;
  const Polylines drawn = smooth_lines(join({zigzag, zigzag.leftCols(2)}));
  ASSERT_EQ(drawn.count(), 2);
  const Points line = drawn.line(0);
  EXPECT_EQ(line.col(0), zigzag.col(0));
  EXPECT_EQ(line.col(line.cols() - 1), zigzag.col(4));
  for (Index i = 1; i + 1 < line.cols(); ++i) {
    const Vec3 before = (line.col(i) - line.col(i - 1)).normalized(),
               after = (line.col(i + 1) - line.col(i)).normalized();
    EXPECT_GT(before.dot(after), std::cos(radians(30))) << i;  // 90 degrees as given
  }
  EXPECT_EQ(drawn.line(1), zigzag.leftCols(2));
}

}  // namespace gracilis
