#include <gracilis/core/whole_number.hpp>

#include <gtest/gtest.h>

namespace gracilis {

TEST(WholeNumber, what_fits_stays_what_it_is) {
  EXPECT_EQ(whole_number<int>(7LL), 7);
  EXPECT_EQ(whole_number<int>(-7.0), -7);
  EXPECT_EQ(whole_number<long long>(9.0e15), 9'000'000'000'000'000LL);
}

TEST(WholeNumber, what_a_cast_would_wrap_around_is_nothing) {
  EXPECT_EQ(whole_number<int>(2147483648LL), std::nullopt);
  EXPECT_EQ(whole_number<int>(4294967297LL), std::nullopt);
  EXPECT_EQ(whole_number<std::size_t>(-1), std::nullopt);
  EXPECT_EQ(whole_number<long long>(9223372036854775808.0), std::nullopt);
}

TEST(WholeNumber, fractions_infinities_and_nan_are_nothing) {
  EXPECT_EQ(whole_number<int>(2.5), std::nullopt);
  EXPECT_EQ(whole_number<int>(std::numeric_limits<double>::infinity()), std::nullopt);
  EXPECT_EQ(whole_number<int>(std::numeric_limits<double>::quiet_NaN()), std::nullopt);
}

TEST(WholeNumber, bounds_are_allowed_themselves) {
  EXPECT_EQ(whole_number(5LL, 0, 5), 5);
  EXPECT_EQ(whole_number(6LL, 0, 5), std::nullopt);
  EXPECT_EQ(whole_number(-1LL, 0, 5), std::nullopt);
}

}  // namespace gracilis
