#include <gracilis/core/median.hpp>

#include <gtest/gtest.h>

namespace gracilis {

TEST(Median, is_the_middle_value_or_the_mean_of_two_middle_ones) {
  EXPECT_EQ(median({3}), 3);
  EXPECT_EQ(median({3, 9, 1}), 3);
  EXPECT_EQ(median({3, 9, 1, 5}), 4);
  EXPECT_EQ(median({7, 2}), 4.5);
}

TEST(Median, of_nothing_is_0) { EXPECT_EQ(median({}), 0); }

}  // namespace gracilis
