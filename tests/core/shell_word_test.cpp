#include <gracilis/core/shell_word.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

TEST(ShellWord, is_quoted_only_where_a_shell_would_take_it_apart) {
  EXPECT_EQ(shell_word("runs/leg_1.toml"), "runs/leg_1.toml");
  EXPECT_EQ(shell_word("my runs/leg"), "'my runs/leg'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word("$HOME"), "'$HOME'");
  EXPECT_EQ(shell_word(""), "''");
}

}  // namespace
}  // namespace gracilis
