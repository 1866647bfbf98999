#include <gracilis/anatomy/activation/tendon.hpp>
#include <gracilis/anatomy/sections/line_sections.hpp>

#include "anatomy/muscles_for_tests.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

TEST(BellyShares, are_one_everywhere_where_nothing_is_attached_or_tendons_have_no_length) {
  const Muscle muscle = tube_muscle();
  Muscle loose = muscle;
  loose.attachments.clear();
  for (const auto& shares : {belly_shares(muscle, 0), belly_shares(loose, 0.02)}) {
    ASSERT_EQ(static_cast<Index>(shares.size()), muscle.surface.vertex_count());
    for (const Real share : shares) EXPECT_EQ(share, 1);
  }
}

TEST(BellyShares, rise_smoothly_from_none_where_the_muscle_is_attached_to_all_at_the_tendons_end) {
  const Muscle muscle = tube_muscle();
  const std::vector<Real> shares = belly_shares(muscle, 0.02);
  for (const Attachment& attachment : muscle.attachments)
    for (const Index v : attachment.vertices) EXPECT_EQ(shares[static_cast<std::size_t>(v)], 0);
  for (Index v = 0; v < 40 * 81; ++v) {  // the tube's side, whose edges run along it
    const Real z = muscle.surface.vertices(2, v), t = std::min(std::min(z, 0.2 - z) / 0.02, 1.0);
    EXPECT_NEAR(shares[static_cast<std::size_t>(v)], t * t * (3 - 2 * t), 1e-9);
  }
}

TEST(DistanceFromTendon, is_that_along_the_line_from_the_nearer_tendon_and_infinite_without_any) {
  LineSections sections;
  sections.length = 0.2;
  sections.places = {0, 0.05, 0.1, 0.15, 0.2};
  for (Index k = 0; k < 5; ++k) EXPECT_EQ(distance_from_tendon(sections, k), std::numeric_limits<Real>::infinity());
  sections.line.origin_tendon = 0.04;
  EXPECT_NEAR(distance_from_tendon(sections, 0), -0.04, 1e-15);
  EXPECT_NEAR(distance_from_tendon(sections, 3), 0.11, 1e-15);
  sections.line.tendon = 0.03;
  EXPECT_NEAR(distance_from_tendon(sections, 1), 0.01, 1e-15);
  EXPECT_NEAR(distance_from_tendon(sections, 3), 0.02, 1e-15);
  EXPECT_NEAR(distance_from_tendon(sections, 4), -0.03, 1e-15);
}

}  // namespace gracilis
