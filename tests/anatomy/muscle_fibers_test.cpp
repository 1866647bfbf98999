#include <gracilis/anatomy/fibers/muscle_fibers.hpp>

#include <gracilis/anatomy/attachments/attachment_samples.hpp>

#include "anatomy/muscles_for_tests.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace gracilis {
namespace {

/// From the origin along z, then bent towards `side` x by `turn` in all; length 1.
Points arc(Real turn, Real side) {
  constexpr Index count = 4001;
  Points line(3, count);
  for (Index i = 0; i < count; ++i) {
    const Real angle = turn * i / (count - 1);
    line.col(i) = Vec3(side * (1 - std::cos(angle)), 0, std::sin(angle)) / turn;
  }
  return line;
}

Muscle with_lines(const std::vector<Points>& lines) {
  Muscle muscle = tube_muscle();
  muscle.given_fibers = join(lines);
  muscle.fibers.segments = 8;
  return muscle;
}

}  // namespace

TEST(FiberMeasures, pennation_is_that_of_the_first_tenth_to_the_mean_of_all) {
  // The chord of a tenth of an arc runs at a twentieth of the arc's turn from its tangent, and the last one's as far
  // from the direction at the end.
  const Real turn = 1;
  const FiberMeasures measures = measure_fibers(join({arc(turn, 1), arc(turn, -1)}));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(measures.lengths[i], 1, 1e-6);
    EXPECT_NEAR(measures.origin_pennation[i], turn / 20, 1e-5);
    EXPECT_NEAR(measures.insertion_pennation[i], turn - turn / 20, 1e-5);
  }
}

TEST(FiberMeasures, the_cross_section_is_the_volume_over_the_mean_length) {
  Points line(3, 2);
  line << 0, 0, 0, 0, 0, 0.1;
  const Polylines fibers = join({line, 3 * line});
  EXPECT_NEAR(mean_fiber_length(fibers), 0.2, 1e-15);
  EXPECT_NEAR(physiological_cross_section(4e-4, fibers), 2e-3, 1e-15);
  EXPECT_EQ(mean_fiber_length(Polylines()), 0);
  EXPECT_EQ(physiological_cross_section(4e-4, Polylines()), 0);
}

TEST(AttachedFibers, given_ones_begin_at_the_origin_and_have_as_many_pieces_as_asked_for) {
  Points up(3, 3);
  up << 0.005, 0.005, 0.005, 0, 0, 0, 0.01, 0.03, 0.19;
  const Points down = up.rowwise().reverse();
  const Polylines fibers = attached_fibers_of(with_lines({up, down}));
  ASSERT_EQ(fibers.count(), 2);
  for (Index i = 0; i < 2; ++i) {
    ASSERT_EQ(fibers.size(i), 9);
    for (Index k = 0; k < 9; ++k)
      EXPECT_LT((fibers.line(i).col(k) - Vec3(0.005, 0, 0.01 + 0.18 * k / 8)).norm(), 1e-12) << i << ' ' << k;
  }
}

TEST(AttachedFibers, a_muscle_that_wants_none_or_lacks_an_end_has_none) {
  Points up(3, 2);
  up << 0, 0, 0, 0, 0.01, 0.19;
  Muscle muscle = with_lines({up});
  EXPECT_EQ(attached_fibers_of(muscle).count(), 1);
  EXPECT_EQ(fibers_of(muscle).count(), 1);
  for (const std::size_t missing : {0u, 1u}) {
    Muscle half = muscle;
    half.attachments.erase(half.attachments.begin() + static_cast<std::ptrdiff_t>(missing));
    EXPECT_EQ(attached_fibers_of(half).count(), 0);
    EXPECT_EQ(fibers_of(half).count(), 0);
  }
  muscle.fibers.count = 0;
  EXPECT_EQ(attached_fibers_of(muscle).count(), 0);
}

}  // namespace gracilis
