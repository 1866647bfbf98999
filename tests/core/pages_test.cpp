#include <build_paths.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

/// The repository's pages.
namespace {

namespace fs = std::filesystem;

const fs::path root = build_paths::source_folder;

/// All .md files but those below build and out.
std::set<fs::path> pages() {
  std::set<fs::path> found;
  for (fs::recursive_directory_iterator entry(root), end; entry != end; ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory() && (name == "build" || name == "out" || name == ".git" || name == "node_modules"))
      entry.disable_recursion_pending();
    else if (entry->path().extension() == ".md")
      found.insert(entry->path());
  }
  return found;
}

/// Targets of a page's links and pictures, without the part after #; those to other sites are left out.
std::set<std::string> linked_files(const std::string& text) {
  static const std::regex link(R"(\]\(([^)#\s]+)(#[^)\s]*)?\))");
  std::set<std::string> targets;
  for (auto match = std::sregex_iterator(text.begin(), text.end(), link); match != std::sregex_iterator(); ++match) {
    const std::string target = (*match)[1];
    if (target.find("://") == std::string::npos && !target.starts_with("mailto:")) targets.insert(target);
  }
  return targets;
}

std::string text_of(const fs::path& page) {
  std::ifstream file(page);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Pages, links_lead_to_files_that_are_there) {
  std::size_t links = 0;
  for (const fs::path& page : pages())
    for (const std::string& target : linked_files(text_of(page))) {
      ++links;
      EXPECT_TRUE(fs::exists(page.parent_path() / target)) << page.lexically_relative(root) << " links " << target;
    }
  EXPECT_GT(links, 60u);
}

TEST(Pages, a_link_that_leads_nowhere_would_be_found) {
  EXPECT_EQ(linked_files("[a](b.md#c) ![p](d/e.png) [s](https://site.org/x) (f.md)"),
            (std::set<std::string>{"b.md", "d/e.png"}));
}

}  // namespace
