#include <gracilis/dynamics/solver/constraint_table.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace gracilis {
namespace {

TEST(ConstraintTable, has_one_row_for_every_kind) {
  std::set<ConstraintKind> kinds;
  for (const ConstraintRow& row : constraint_table())
    EXPECT_TRUE(kinds.insert(row.kind).second) << row.name << " stands twice";
  EXPECT_EQ(kinds.size(), static_cast<std::size_t>(ConstraintKind::bone_contact));
  EXPECT_FALSE(kinds.contains(ConstraintKind::none));
}

TEST(ConstraintTable, names_every_kind_by_a_name_of_its_own) {
  std::set<std::string> names = {name_of(ConstraintKind::none)};
  for (const ConstraintRow& row : constraint_table()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_STREQ(name_of(row.kind), row.name);
  }
}

TEST(ConstraintTable, is_in_the_order_of_phases_and_ends_with_bones) {
  const auto rows = constraint_table();
  const auto earlier = [](const ConstraintRow& l, const ConstraintRow& r) { return l.phase < r.phase; };
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end(), earlier));
  EXPECT_EQ(rows.back().kind, ConstraintKind::bone_contact) << "something else could push back into a bone";
}

TEST(ConstraintTable, only_contact_between_surfaces_is_projected_by_no_one_surface) {
  for (const ConstraintRow& row : constraint_table())
    EXPECT_EQ(row.project == nullptr, row.phase == ConstraintPhase::contact) << row.name;
}

}  // namespace
}  // namespace gracilis
