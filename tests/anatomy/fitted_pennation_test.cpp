#include <gracilis/anatomy/fibers/fitted_pennation.hpp>

#include <pennate_muscles.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {
namespace {

/// The made muscle of fascicles of 30 mm at 30 degrees, held at its two tips alone, as tendons hold it.
Muscle held_at_its_tips() {
  Muscle muscle = PennateMuscle(false, 0).muscle();
  const Real low = muscle.surface.vertices.row(0).minCoeff(), high = muscle.surface.vertices.row(0).maxCoeff();
  for (Attachment& each : muscle.attachments)
    std::erase_if(each.vertices, [&](Index v) {
      const Real x = muscle.surface.vertices(0, v);
      return each.end == AttachmentEnd::origin ? x > low + 0.02 : x < high - 0.02;
    });
  return muscle;
}

}  // namespace

TEST(FittedPennation, makes_fibers_as_long_as_they_are_known_to_be) {
  const std::optional<Real> found = fitted_pennation(held_at_its_tips(), 0.030);
  ASSERT_TRUE(found);
  EXPECT_NEAR(degrees(*found), 30, 4) << "fibers near the tips are cut off by them";
  const std::optional<Real> longer = fitted_pennation(held_at_its_tips(), 0.045);
  ASSERT_TRUE(longer);
  EXPECT_LT(degrees(*longer), degrees(*found) - 5);
}

TEST(FittedPennation, is_none_where_no_angle_makes_such_fibers) {
  EXPECT_FALSE(fitted_pennation(held_at_its_tips(), 1));
  EXPECT_FALSE(fitted_pennation(held_at_its_tips(), 0.001));
}

TEST(FittedPennation, is_none_where_aponeuroses_are_known) {
  EXPECT_FALSE(fitted_pennation(PennateMuscle(false, 0).with_aponeuroses(), 0.030));
}

}  // namespace gracilis
