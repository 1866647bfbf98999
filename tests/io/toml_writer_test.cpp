#include <gracilis/io/parse_toml.hpp>
#include <gracilis/io/toml_writer.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {
namespace {

TEST(TomlWriter, what_it_writes_reads_back_the_same_in_lines_that_people_can_read) {
  std::string numbers;
  for (int i = 0; i < 300; ++i) numbers += std::to_string(i) + ", ";
  const toml::table table = parse_toml("a = 1\nb = \"two \\\" lines\\n\"\nc = [0.5, 2.0, 1e-9]\nlong = [" + numbers +
                                           "]\n\"odd key\" = true\n[t]\nx = { y = 1.0 }\n[[l]]\nn = \"one\"\n"
                                           "[[l.m]]\nk = [[1, 2], [3, 4]]\n[[l]]\nn = \"two\"\n",
                                       "test");
  const std::string text = toml_of(table);
  EXPECT_EQ(parse_toml(text, "again"), table) << text;
  EXPECT_THAT(text, testing::HasSubstr("[[l.m]]"));
  std::size_t longest = 0, begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    longest = std::max(longest, end - begin);
  EXPECT_LE(longest, 122u);
}

}  // namespace
}  // namespace gracilis
