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

TEST(Suggestions, names_without_end_are_near_to_none_and_cut_in_messages) {
  // The table of distances of the two would have 40 thousand million cells.
  const std::string word(200'000, 'a'), other = std::string(199'999, 'a') + "b";
  EXPECT_EQ(nearest_word(word, {other}), "");
  EXPECT_EQ(suggestion("hip", {other}), "known are '" + std::string(120, 'a') + "...'");
  EXPECT_EQ(shortened(std::string(119, 'a') + "\u00e9\u00e9"), std::string(119, 'a') + "...") << "no half of a letter";
  EXPECT_EQ(shortened("hip"), "hip");
}

TEST(Suggestions, of_thousands_of_names_forty_are_listed) {
  std::vector<std::string> names;
  for (int i = 0; i < 1000; ++i) names.push_back("bone_" + std::to_string(i));
  const std::string text = suggestion("x", names);
  EXPECT_TRUE(text.ends_with("'bone_39' and 960 more")) << text;
}

}  // namespace gracilis
