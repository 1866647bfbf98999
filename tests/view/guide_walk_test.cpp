#include "view/guide_blocks.hpp"
#include "view/live_page_file.hpp"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

/// What the pages below docs tell people to type, typed. Those commands that take long are typed by the long tests.
namespace gracilis {

namespace {

/// `gracilis COMMAND ... --option` anywhere in a page, in a block or between backquotes.
std::vector<std::string> named_commands(const std::string& text) {
  std::vector<std::string> found;
  const std::regex in_text("`gracilis ([a-z][^`]*)`");
  for (std::sregex_iterator each(text.begin(), text.end(), in_text), end; each != end; ++each)
    found.push_back((*each)[1]);
  for (const CommandBlock& block : command_blocks("", text)) {
    std::istringstream lines(block.text);
    for (std::string line; std::getline(lines, line);)
      if (is_command(line)) found.push_back(line.substr(line.find("gracilis ") + 9));
  }
  return found;
}

/// The words before the first option or file of a command that has such commands.
std::string command_path(const std::string& words) {
  std::istringstream stream(words);
  std::string first, second;
  stream >> first >> second;
  return first == "study" || first == "activations" ? first + " " + second : first;
}

}  // namespace

TEST(GuideWalk, every_command_works) {
  const TestFolder folder;
  const bool has_page = std::filesystem::exists(live_page());
  const int walked = walk_manual(folder, [&](const CommandBlock& block) {
    return !block.says("long") && !block.says("data") && (has_page || !block.says("page"));
  });
  EXPECT_GT(walked, 8);
}

TEST(GuideWalk, every_option_that_a_page_names_is_one_of_its_command) {
  std::map<std::string, std::string> helps;
  int options = 0;
  for (const auto& [page, text] : manual_pages())
    for (const std::string& words : named_commands(text)) {
      const std::string path = command_path(words);
      const auto [help, is_new] = helps.try_emplace(path);
      if (is_new) help->second = run_program(path + " --help").out;
      EXPECT_NE(help->second, "") << page << ": gracilis " << words;
      const std::string before_comment = words.substr(0, words.find(" # "));
      const std::regex option(" (--[a-z][a-z-]*)");
      for (std::sregex_iterator each(before_comment.begin(), before_comment.end(), option), end; each != end; ++each) {
        ++options;
        EXPECT_TRUE(std::regex_search(help->second, std::regex((*each)[1].str() + "[^a-z-]")))
            << page << ": gracilis " << words;
      }
    }
  EXPECT_GT(options, 40);
}

TEST(GuideWalk, scripts_that_pages_name_are_there) {
  const std::regex script("(^|\\n    |`)((reproductions|studies|docs|tools)/[a-z0-9_/-]+\\.(sh|py))");
  int scripts = 0;
  for (const auto& [page, text] : manual_pages())
    for (std::sregex_iterator each(text.begin(), text.end(), script), end; each != end; ++each) {
      ++scripts;
      EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(build_paths::source_folder) / (*each)[2].str()))
          << page << " names " << (*each)[2];
    }
  EXPECT_GT(scripts, 5);
}

TEST(GuideWalk, blocks_and_their_marks_are_found) {
  const std::vector<CommandBlock> blocks = command_blocks("page",
                                                          "    gracilis a\n\n    more\ntext\n<!-- walk: X -> y z; long "
                                                          "-->\n\n```sh\ngracilis X\n```\n\n```toml\na = 1\n```\n");
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(blocks[0].place, "page:1");
  EXPECT_EQ(typed_text(blocks[0]), "gracilis a\nmore\n");
  EXPECT_EQ(typed_text(blocks[1]), "gracilis y z\n");
  EXPECT_TRUE(blocks[1].says("long"));
  EXPECT_FALSE(blocks[1].is_left_out());
}

TEST(GuideWalk, a_command_that_fails_is_told) {
  const TestFolder folder;
  const CommandBlock block{"page:1", {}, "gracilis run not_there.toml\ntrue\n"};
  EXPECT_NONFATAL_FAILURE(walk(block, folder.path()), "not_there.toml");
}

}  // namespace gracilis
