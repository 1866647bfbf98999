#include <gracilis/anatomy/fibers/guide_tracts.hpp>
#include <gracilis/geometry/measures.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {

TEST(GuideTracts, samples_of_an_arc_are_its_tangents) {
  const TriangleMesh block = shapes::box({-0.05, -0.05, -0.01}, {0.05, 0.05, 0.01});
  const SolidGrid grid(block, SignedDistance(block), {}, 2000);
  Points arc(3, 49);
  for (Index i = 0; i < arc.cols(); ++i) {
    const Real angle = 0.03 * i;
    arc.col(i) = 0.03 * Vec3(std::cos(angle), std::sin(angle), 0);
  }
  const std::vector<DirectionSample> samples = samples_of_tracts(grid, join({arc}));
  ASSERT_EQ(samples.size(), 13u);
  for (const DirectionSample& sample : samples) {
    // What is averaged lies evenly on both sides of the place. Chords of the arc stand in for it.
    EXPECT_NEAR(sample.direction.dot(sample.place.normalized()), 0, 1e-3);
    EXPECT_GT(sample.direction.dot(Vec3(-sample.place.y(), sample.place.x(), 0)), 0) << "along the tract";
    EXPECT_NEAR(sample.direction.norm(), 1, 1e-12);
    EXPECT_NEAR(sample.weight, polyline_length(arc) / 24, 1e-5);
  }
}

}  // namespace gracilis
