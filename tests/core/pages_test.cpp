#include <build_paths.hpp>

#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>

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

/// Where links into a page lead: what GitHub and the site make of its headings, each next one of a kind with a number.
std::set<std::string> anchors_of(const std::string& text) {
  std::set<std::string> anchors;
  bool code = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) code = !code;
    const std::size_t level = line.find_first_not_of('#');
    if (code || level == 0 || level == std::string::npos || line[level] != ' ') continue;
    static const std::regex link(R"(\[([^\]]*)\]\([^)]*\))");
    const std::string heading = std::regex_replace(line.substr(level + 1), link, "$1");
    std::string anchor;
    for (std::size_t i = 0; i < heading.size(); ++i) {
      const unsigned char c = static_cast<unsigned char>(heading[i]);
      if (c == 0xE2)
        i += 2;  // dashes, quotation marks, arrows
      else if (c == ' ')
        anchor += '-';
      else if (c >= 0x80 || c == '-' || c == '_' || std::isalnum(c))
        anchor += static_cast<char>(std::tolower(c));
    }
    std::string numbered = anchor;
    for (int i = 1; !anchors.insert(numbered).second; ++i) numbered = anchor + "-" + std::to_string(i);
  }
  return anchors;
}

/// Pages and the places in them that a page's links name; an empty page is itself.
std::set<std::pair<std::string, std::string>> linked_places(const std::string& text) {
  static const std::regex link(R"(\]\(([^)#\s]*)#([^)\s]+)\))");
  std::set<std::pair<std::string, std::string>> places;
  for (auto match = std::sregex_iterator(text.begin(), text.end(), link); match != std::sregex_iterator(); ++match)
    if ((*match)[1].str().find("://") == std::string::npos) places.emplace((*match)[1], (*match)[2]);
  return places;
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

TEST(Pages, links_into_pages_lead_to_headings_that_are_there) {
  std::size_t links = 0;
  for (const fs::path& page : pages())
    for (const auto& [target, anchor] : linked_places(text_of(page))) {
      ++links;
      const fs::path there = target.empty() ? page : page.parent_path() / target;
      EXPECT_EQ(anchors_of(text_of(there)).count(anchor), 1u)
          << page.lexically_relative(root) << " links " << target << "#" << anchor;
    }
  EXPECT_GT(links, 10u);
}

TEST(Pages, every_page_of_the_guide_is_in_the_navigation_of_the_site) {
  const std::string navigation = text_of(root / "docs/site/mkdocs.yml");
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / "docs")) {
    const std::string page = entry.path().lexically_relative(root).string();
    if (entry.path().extension() != ".md" || page.starts_with("docs/decisions/"))
      continue;  // listed by docs/site/pages.py
    EXPECT_NE(navigation.find(": " + page + "\n"), std::string::npos) << page;
  }
}

TEST(Pages, headings_have_the_anchors_that_sites_give_them) {
  EXPECT_EQ(anchors_of("# A `b-c`, d!\n```\n# no\n```\n## [E](f.md) — g\n## A `b-c`, d!\n"),
            (std::set<std::string>{"a-b-c-d", "e--g", "a-b-c-d-1"}));
  EXPECT_EQ(linked_places("[a](b.md#c) [d](#e) [s](https://x.org/#y) [f](g.md)"),
            (std::set<std::pair<std::string, std::string>>{{"b.md", "c"}, {"", "e"}}));
}

TEST(Pages, a_link_that_leads_nowhere_would_be_found) {
  EXPECT_EQ(linked_files("[a](b.md#c) ![p](d/e.png) [s](https://site.org/x) (f.md)"),
            (std::set<std::string>{"b.md", "d/e.png"}));
}

}  // namespace
