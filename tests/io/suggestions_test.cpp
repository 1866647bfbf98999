#include <gracilis/io/suggestions.hpp>

#include <gtest/gtest.h>

namespace gracilis {

TEST(Suggestions, a_swap_of_neighbors_counts_once) {
  EXPECT_EQ(edit_distance("muscel", "muscle"), 1);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("same", "same"), 0);
}

TEST(Suggestions, the_nearest_word_wins_and_a_far_one_is_none) {
  const std::vector<std::string> words = {"iterations", "substeps", "time_step", "hold_frames"};
  EXPECT_EQ(nearest_word("iteration", words), "iterations");
  EXPECT_EQ(nearest_word("timestep", words), "time_step");
  EXPECT_EQ(nearest_word("hold", words), "hold_frames") << "the only one that begins so";
  EXPECT_EQ(nearest_word("viscosity", words), "");
  EXPECT_EQ(nearest_word("x", words), "");
  EXPECT_EQ(nearest_word("x", {}), "");
}

TEST(Suggestions, without_a_near_word_all_are_listed) {
  EXPECT_EQ(suggestion("color", {"name", "file"}), "known are 'name', 'file'");
  EXPECT_EQ(suggestion("fil", {"name", "file"}), "did you mean 'file'?");
  EXPECT_EQ(suggestion("fil", {}), "none is known here");
}

}  // namespace gracilis
