#include <build_paths.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

/// What the API reference is made of.
namespace {

namespace fs = std::filesystem;

/// Where a comment names `<something>` outside of backticks: Doxygen takes that for HTML, and the site is not built.
/// Lines that stand further in are shown as they are.
bool has_bare_tag(const std::string& line) {
  static const std::regex comment(R"(^\s*///(?!   ))"), code("`[^`]*`"), tag("(^|[^A-Za-z0-9_])<[A-Za-z_]+>");
  return std::regex_search(line, comment) && std::regex_search(std::regex_replace(line, code, ""), tag);
}

TEST(Headers, a_tag_in_a_comment_is_recognized) {
  EXPECT_TRUE(has_bare_tag("/// below its <path>; may be empty"));
  EXPECT_FALSE(has_bare_tag("/// below its `<path>`; may be empty"));
  EXPECT_FALSE(has_bare_tag("/// a std::vector<Real> of them"));
  EXPECT_FALSE(has_bare_tag("#include <vector>"));
}

TEST(Headers, comments_name_tags_in_backticks_alone) {
  int headers = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(build_paths::source_folder) / "src" / "gracilis")) {
    if (entry.path().extension() != ".hpp") continue;
    ++headers;
    std::ifstream file(entry.path());
    int number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      EXPECT_FALSE(has_bare_tag(line)) << entry.path().string() << ":" << number << ": " << line;
    }
  }
  EXPECT_GT(headers, 100);
}

}  // namespace
