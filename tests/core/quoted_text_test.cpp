#include <gracilis/core/quoted_text.hpp>

#include <gtest/gtest.h>
#include <toml++/toml.h>
#include <nlohmann/json.hpp>

using gracilis::quoted_text;

TEST(QuotedText, is_read_back_by_toml_and_json) {
  for (const std::string text : {"", "plain", "a \"quoted\" word", "C:\\bones\\femur", "two\nlines", "ends in \\"}) {
    EXPECT_EQ(nlohmann::json::parse(quoted_text(text)), text);
    EXPECT_EQ(toml::parse("key = " + quoted_text(text))["key"].value<std::string>(), text);
  }
}

TEST(QuotedText, has_a_space_where_another_character_would_end_it) { EXPECT_EQ(quoted_text("a\tb\x01"), "\"a b \""); }
