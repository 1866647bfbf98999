#include <gracilis/core/errors.hpp>

#include <gtest/gtest.h>

namespace gracilis {

TEST(Errors, a_problem_reads_as_place_cause_and_remedy) {
  EXPECT_EQ(to_string({"hip.toml", "3:1", "unknown key 'iteration'", "did you mean 'iterations'?"}),
            "hip.toml:3:1: unknown key 'iteration' (did you mean 'iterations'?)");
  EXPECT_EQ(to_string({"", "", "no muscles", ""}), "no muscles");
}

TEST(Errors, all_problems_are_listed_one_per_line_with_the_exit_code_of_their_kind) {
  const InputError error({{"a.ply", "", "empty", ""}, {"b.ply", "face 3", "degenerate", ""}});
  EXPECT_STREQ(error.what(), "a.ply: empty\nb.ply:face 3: degenerate");
  EXPECT_EQ(error.code(), ExitCode::unreadable_input);
}

}  // namespace gracilis
