#include "app/program.hpp"
#include "io/scene_folder.hpp"

#include <build_paths.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

/// Which figures and tables of the publications the pages have, and what they say beside each.
namespace gracilis {
namespace {

const std::string reproductions_folder = std::string(build_paths::source_folder) + "/reproductions";

/// What a script says that sees the modules of the reproductions' family.
std::string said_by_family(const SceneFolder& folder, const std::string& text) {
  folder.write("script.py", "import sys\nsys.path.insert(0, '" + reproductions_folder + "/family')\n" + text);
  return said_by("cd " + folder.path("").string() + " && timeout 20 python3 -B script.py 2>&1; echo \"code $?\"");
}

/// A page with one chart of these curves; then what it says of the chart.
std::string said_of_chart(const std::string& title, const std::string& curves, const std::string& sentences = "") {
  const SceneFolder folder;
  return said_by_family(folder,
                        "import os\nimport publication\nfrom charts import Series, published\nos.makedirs('out')\n"
                        "page = publication.Page('out', 't', 'a', 'c')\n"
                        "page.chart('f', '" +
                            title + "', '', [" + curves + "], 'x', 'y'" + sentences +
                            ")\n"
                            "print(page.figures[0][-1])\npage.write()\n");
}

}  // namespace

TEST(PublishedFigures, each_of_them_is_on_its_page_or_among_what_is_not_made) {
  const std::map<std::string, std::string> asked = {
      {"havlicek-2024", "Figures 4.1, 6.1 to 6.6, 7.1 to 7.11 and A.1 to A.14; Tables 6.1 and B.1"},
      {"cervenka-kohout-2020", "Figures 1 to 22; Table 1"},
      {"janak-2012", "Figures 5.1 to 5.18; Tables 5.1 to 5.3"},
      {"cervenka-2024", "Figures 2.1, 2.2, 3.1, 4.1 to 4.4 and 5.1 to 5.13; Tables 3.1 and 3.2"},
      {"lacle-2014", "Figures 3.9, 3.15, 3.22 and 5.1 to 5.6; Tables 3.1 to 3.4 and 5.1 to 5.3"}};
  for (const auto& [name, figures] : asked) {
    const SceneFolder folder;
    const std::string here = reproductions_folder + "/" + name;
    EXPECT_EQ(said_by_family(
                  folder, "from naming import named, not_made, on_page\nhere = '" + here + "'\nasked = set(named('" +
                              figures + "'))\nprint(len(asked) > 5, sorted(asked - on_page(here) - not_made(here)))\n"),
              "True []\ncode 0\n")
        << name;
  }
}

TEST(PublishedFigures, names_in_a_text_are_found_one_by_one) {
  const SceneFolder folder;
  EXPECT_EQ(said_by_family(folder,
                           "from naming import named\n"
                           "print(named('Figures 5.3, 5.9 to 5.11 and A.1: curves, section 6.1'))\n"
                           "print(named('Figure 3.9a'), named('Table B.1 and Figures 20 and 21'), named('page 3'))\n"),
            "['Figure 5.3', 'Figure 5.9', 'Figure 5.10', 'Figure 5.11', 'Figure A.1']\n"
            "['Figure 3.9'] ['Table B.1', 'Figure 20', 'Figure 21'] []\ncode 0\n");
}

TEST(PublishedFigures, one_that_says_nothing_of_how_it_compares_is_an_error) {
  const std::string line = "Series('ours', [(0, 1), (1, 2)])";
  const std::string unexplained = "differs, not explained: Figure 1: a line\ncode 1\n";
  EXPECT_EQ(said_of_chart("Figure 1: a line", line), "['differs, not explained']\n" + unexplained);
  EXPECT_EQ(said_of_chart("Figure 1: a line", line, ", same='it rises'"), "['As published: it rises']\ncode 0\n");
  EXPECT_EQ(said_of_chart("Beside Figure 1: a line", line), "[]\ncode 0\n");
  EXPECT_EQ(said_of_chart("Section 1: a line", line), "[]\ncode 0\n");
}

TEST(PublishedFigures, a_published_curve_that_none_of_ours_follows_needs_a_sentence_why) {
  const auto beside = [](const std::string& ours) {
    return "published('theirs', [(0, 0), (2, 10)]), Series('ours', [" + ours + "])";
  };
  EXPECT_EQ(said_of_chart("Figure 1", beside("(0, 0.1), (1, 4.9), (2, 10)"), ", same='x'"),
            "['As published: x']\ncode 0\n");
  EXPECT_THAT(
      said_of_chart("Figure 1", beside("(0, 0.1), (1, 4.9), (2, 9)"), ", same='x'"),
      testing::HasSubstr("['As published: x', 'differs, not explained: theirs']\ndiffers, not explained: Figure 1\n"));
  EXPECT_EQ(said_of_chart("Figure 1", beside("(0, 5), (2, 5)"), ", differs='it is level'"),
            "['Differs: it is level']\ncode 0\n");
  EXPECT_EQ(said_of_chart("Section 1", beside("(3, 5), (4, 5)")), "[]\ncode 0\n");  // no angle in common
}

TEST(PublishedFigures, curves_and_axes_without_a_name_are_errors) {
  EXPECT_THAT(said_of_chart("Section 1", "Series('', [(0, 1)])"),
              testing::HasSubstr("a curve without a name\ncode 1\n"));
  const SceneFolder folder;
  EXPECT_THAT(said_by_family(folder,
                             "import publication\n"
                             "publication.Page('out', 't', 'a', 'c').chart('f', 'Section 1', '', [], 'mm', 'mm')\n"),
              testing::HasSubstr("axes need names of their own: Section 1\ncode 1\n"));
}

}  // namespace gracilis
