#include <gracilis/scene/names.hpp>

#include <gtest/gtest.h>

namespace gracilis {

TEST(Names, foreign_text_never_leads_out_of_a_folder) {
  EXPECT_EQ(file_name_of("../../etc/passwd"), "_._.._etc_passwd");
  EXPECT_EQ(file_name_of("/etc/passwd"), "_etc_passwd");
  EXPECT_EQ(file_name_of(".."), "_.");
  EXPECT_EQ(file_name_of("a\\b:c\n"), "a_b_c_");
  EXPECT_EQ(file_name_of("-rf"), "-rf");
  for (const char* text : {"../a", "/", "..", ".", "", "a/../b", "\xc3\xa9/..", "\0"})
    EXPECT_TRUE(fits_file_name(file_name_of(text))) << text;
}

TEST(Names, what_fits_stays_what_it_is) {
  for (const char* text : {"psoas_r", "gait.2392", "A-b_3"}) EXPECT_EQ(file_name_of(text), text);
  EXPECT_EQ(file_name_of(""), "unnamed");
}

TEST(Names, long_ones_are_cut_and_equal_ones_told_apart) {
  EXPECT_EQ(file_name_of(std::string(5000, 'a')), std::string(longest_name, 'a'));
  std::set<std::string> taken;
  EXPECT_EQ(file_name_of("a/b", taken), "a_b");
  EXPECT_EQ(file_name_of("a:b", taken), "a_b_2");
  EXPECT_EQ(file_name_of("a_b", taken), "a_b_3");
  EXPECT_EQ(file_name_of(std::string(5000, 'a'), taken).size(), longest_name);
  EXPECT_EQ(file_name_of(std::string(5000, 'a'), taken).size(), longest_name);
  EXPECT_EQ(taken.size(), 5u);
}

}  // namespace gracilis
