#include <gracilis/core/group_by_key.hpp>

#include <gtest/gtest.h>

#include <array>

namespace gracilis {

TEST(GroupByKey, items_stand_by_their_keys_and_ascend_within_each) {
  const std::array<Index, 6> keys = {2, 0, 2, 3, 0, 2};
  const GroupedByKey groups = group_by_key(keys, 5);
  const auto with = [&](Index key) { return std::vector<Index>(groups.with(key).begin(), groups.with(key).end()); };
  EXPECT_EQ(with(0), (std::vector<Index>{1, 4}));
  EXPECT_TRUE(with(1).empty());
  EXPECT_EQ(with(2), (std::vector<Index>{0, 2, 5}));
  EXPECT_EQ(with(3), (std::vector<Index>{3}));
  EXPECT_TRUE(with(4).empty());
}

TEST(GroupByKey, without_items_every_key_is_empty) {
  const GroupedByKey groups = group_by_key({}, 2);
  EXPECT_TRUE(groups.with(0).empty());
  EXPECT_TRUE(groups.with(1).empty());
}

}  // namespace gracilis
