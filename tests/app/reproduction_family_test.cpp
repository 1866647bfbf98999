#include "app/program.hpp"
#include "io/scene_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

/// What the reproductions' scripts share.
namespace gracilis {

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// A folder with a stand-in for gracilis that tells its version.
struct FamilyFolder : SceneFolder {
  FamilyFolder() { program("1.0"); }
  void program(const std::string& version) const {
    write("gracilis", "#!/bin/sh\necho gracilis " + version + "\n");
    fs::permissions(path("gracilis"), fs::perms::owner_all);
  }
  std::string family() const { return std::string(build_paths::source_folder) + "/reproductions/family"; }

  /// A pass of a reproduction with these options that leaves a file of this name in OUT; then what OUT has.
  std::string pass(const std::string& options, const std::string& leaves) const {
    const std::string out = path("out").string();
    write("pass.sh", "set -euo pipefail\nsource " + family() + "/options.sh lacle-2014 \"$@\"\ntouch \"$out/" + leaves +
                         "\"\nls \"$out\" | tr '\\n' ' '\n");
    return said_by("GRACILIS=" + path("gracilis").string() + " bash " + path("pass.sh").string() + " --out " + out +
                   " " + options + "; echo \"code $?\"");
  }

  std::string text(const std::string& name) const { return said_by("cat " + path(name).string()); }

  std::string python(const std::string& text) const {
    write("script.py", "import sys\nsys.path.insert(0, '" + family() + "')\n" + text);
    return said_by("cd " + path("").string() + " && timeout 20 python3 -B script.py; echo \"code $?\"");
  }
};

/// A reproduction of two steps for each of two lengths, one of a template and one that only full passes have.
struct ListedSteps : FamilyFolder {
  ListedSteps() {
    write("here/steps.toml", R"([words]
length = [1, 2]
greeting = "told {length} {whom}"
whom = "twice"
[thin]
length = [1]
[without_data]
of = ["cadaver"]
whom = "once"
[[steps]]
makes = "made/{length}"
command = "sh -c 'echo {greeting} >>OUT/count; mkdir -p OUT/made/{length}; test ! -e OUT/broken'"
[[steps]]
makes = "said"
command = "echo in DATA"
tells = true
full = true
[[steps]]
makes = "of_cadaver"
command = "touch OUT/of_cadaver"
data = ["cadaver"]
[[steps]]
makes = "scene.toml"
template = "scene.toml"
)");
    write("here/scene.toml", "samples = \"OUT/samples.sto\"\n");
  }
  std::string make(const std::string& thin) const {
    return python(
        "import os\nimport steps\nos.makedirs('out', exist_ok=True)\n"
        "todo = steps.Steps('gracilis', os.path.abspath('here'), os.path.abspath('out'), 'data', " +
        thin + ")\ntodo.make()\nprint(sorted(os.listdir('out')), todo.lacks)\n");
  }
};

}  // namespace

TEST(ReproductionFamily, a_pass_goes_on_where_the_same_one_ended_and_another_begins_anew) {
  const FamilyFolder folder;
  EXPECT_EQ(folder.pass("--thin", "thin"), "made_by.txt thin code 0\n");
  EXPECT_EQ(folder.pass("--thin", "more"), "made_by.txt more thin code 0\n");
  for (const std::string options : {"", "--set iterations=3", "--data elsewhere"}) {
    const std::string said = folder.pass(options, "another");
    EXPECT_THAT(said, HasSubstr("made anew")) << options;
    EXPECT_THAT(said, HasSubstr("\nanother made_by.txt code 0\n")) << options;
    EXPECT_THAT(folder.pass(options, "again"), HasSubstr("again another made_by.txt code 0")) << options;
  }
  folder.program("1.1");
  EXPECT_THAT(folder.pass("--data elsewhere", "newer"), HasSubstr("\nmade_by.txt newer code 0\n"));
}

TEST(ReproductionFamily, a_folder_of_other_files_is_left_alone) {
  const FamilyFolder folder;
  folder.write("out/thesis.txt", "ten years");
  const std::string said = folder.pass("", "made");
  EXPECT_THAT(said, HasSubstr("holds files that are not from here"));
  EXPECT_THAT(said, HasSubstr("code 2"));
  EXPECT_TRUE(fs::exists(folder.path("out/thesis.txt")));
  EXPECT_FALSE(fs::exists(folder.path("out/made")));
}

TEST(ReproductionFamily, a_run_is_finished_when_it_says_that_it_is_complete) {
  const FamilyFolder folder;
  const auto is_finished = [&] {
    return said_by("bash -c '. " + folder.family() + "/stamp.sh; is_finished " + folder.path("run").string() +
                   "'; echo $?") == "0\n";
  };
  EXPECT_FALSE(is_finished());
  folder.write("run/measures.csv", "frame\n");
  for (const std::string status : {"running", "interrupted", "failed: complete"}) {
    folder.write("run/run.json", "{\n  \"gracilis\": \"1\",\n  \"status\": \"" + status + "\"\n}\n");
    EXPECT_FALSE(is_finished()) << status;
  }
  folder.write("run/run.json", "{\n  \"gracilis\": \"1\",\n  \"status\": \"complete\",\n  \"frames\": 3\n}\n");
  EXPECT_TRUE(is_finished());
}

TEST(ReproductionFamily, a_complete_pass_fails_and_names_what_its_page_lacks) {
  const FamilyFolder folder;
  folder.write("published.csv",
               "key,quantity,unit,published,source\nlength,a length,m,1,page 3\nmass,a mass,kg,2,page 4\n");
  const auto page = [&](const std::string& ours, const std::string& complete) {
    return folder.python(
        "import os\nimport files\nimport publication\nfrom charts import Series\nos.makedirs('out', exist_ok=True)\n"
        "page = publication.Page('out', 't', 'a', 'c')\n"
        "page.chart('f', 'Figure 1: drawn', '', [Series('a', [(0, 1), (1, 2)])], 'x', 'y', same='a line')\n"
        "page.chart('g', 'Figure 2: empty', '', [Series('a', [])], 'x', 'y')\n"
        "page.rows = publication.beside(files.read('published.csv'), " +
        ours + ")\npage.write(" + complete + ")\n");
  };
  EXPECT_EQ(page("{'length': 1}", "complete=True"), "not made: Figure 2: empty\nnot made: page 4: a mass\ncode 1\n");
  EXPECT_EQ(page("{'length': 1}", ""), "code 0\n");
  EXPECT_EQ(page("{'length': 1, 'mass': 2}", "complete=True"), "not made: Figure 2: empty\ncode 1\n");
}

TEST(ReproductionFamily, steps_are_made_for_every_word_of_a_list_and_only_once) {
  const ListedSteps folder;
  EXPECT_THAT(folder.make("True"), HasSubstr("['count', 'made', 'scene.toml'] {'cadaver'}\ncode 0"));
  EXPECT_EQ(folder.text("out/count"), "told 1 once\n");
  EXPECT_EQ(folder.text("out/scene.toml"), "samples = \"" + folder.path("out").string() + "/samples.sto\"\n");
  folder.write("data/cadaver/bone.ply", "");
  EXPECT_THAT(folder.make("False"),
              HasSubstr("'of_cadaver', 'of_cadaver.txt', 'said', 'said.txt', 'scene.toml'] set()"));
  EXPECT_EQ(folder.text("out/count"), "told 1 once\ntold 1 twice\ntold 2 twice\n");  // another command is another step
  EXPECT_EQ(folder.text("out/said"), "in data\n");
  EXPECT_THAT(folder.make("False"), HasSubstr("code 0"));
  EXPECT_EQ(folder.text("out/count"), "told 1 once\ntold 1 twice\ntold 2 twice\n");
}

TEST(ReproductionFamily, a_step_that_fails_ends_the_pass_and_is_made_again) {
  const ListedSteps folder;
  folder.write("out/broken", "");
  const std::string said = folder.make("True");
  EXPECT_THAT(said, HasSubstr("failed with exit code 1"));
  EXPECT_THAT(said, HasSubstr("code 1\n"));
  EXPECT_THAT(folder.text("out/made/1.txt"), HasSubstr("exit code 1 after"));
  fs::remove(folder.path("out/broken"));
  EXPECT_THAT(folder.make("True"), HasSubstr("code 0"));
  EXPECT_EQ(folder.text("out/count"), "told 1 once\ntold 1 once\n");
}

TEST(ReproductionFamily, a_complete_page_has_a_sentence_where_values_differ_and_bars_hold_always) {
  const FamilyFolder folder;
  folder.write("here/page.toml", R"(title = "t"
about = "a"
[figures."figure_*"]
title = "Figure {number}"
same = "a line of {number} parts"
x = "x"
y = "y"
[left_out]
switch = "does nothing here"
[remarks]
"mass_*" = "of {what}"
)");
  folder.write(
      "here/published.csv",
      "key,quantity,unit,published,source,least,most\nlength,a length,m,1,page 3,,\nmass_1,a mass,kg,2,page 4,,\n"
      "switch,a switch,,1,page 5,,\nerror,an error,%,below 1,page 6,,1\n");
  const auto page = [&](const std::string& puts, const std::string& complete) {
    return folder.python(
        "import os\nimport publication\nfrom charts import Series\nos.makedirs('out', exist_ok=True)\n"
        "page = publication.WordedPage('out', 'here', 'data')\n" +
        puts + "page.write(complete=" + complete + ")\n");
  };
  const std::string drawn = "page.draw('figure_1', [Series('a', [(0, 1), (1, 2)])], {'number': 1})\n",
                    same = drawn + "page.put('length', 1.001)\npage.put('mass_1', 3, what='a bone')\n";
  EXPECT_EQ(page(same + "page.put('error', 'below 1')\n", "True"), "code 0\n");
  EXPECT_THAT(folder.text("out/results.csv"), HasSubstr("page 4,a mass,kg,2,3,1.5,of a bone"));
  EXPECT_THAT(folder.text("out/results.csv"), HasSubstr("page 5,a switch,,1,,,does nothing here"));
  EXPECT_THAT(folder.text("out/index.html"), HasSubstr("<i>As published: a line of 1 parts</i>"));
  EXPECT_EQ(page(same + "page.put('error', 0.5)\n", "True"), "not made: remark on page 6: an error\ncode 1\n");
  EXPECT_EQ(page(drawn + "page.put('length', 1.1)\npage.put('error', 0.5)\n", "False"), "code 0\n");
  EXPECT_THAT(folder.text("out/results.csv"), HasSubstr("page 3,a length,m,1,1.1,1.1,\"differs, not explained\""));
  EXPECT_THAT(page("page.put('length', 1)\n", "True"), HasSubstr("not made: Figure {number}\n"));
  EXPECT_EQ(page("page.put('error', 2)\n", "False"), "missed its bar: an error, 2\ncode 1\n");
}

TEST(ReproductionFamily, lines_are_broken_where_points_are_not_finite) {
  const FamilyFolder folder;
  const std::string said = folder.python(R"(from charts import Series, chart, ticks
nan, inf = float("nan"), float("inf")
svg = chart("a", [Series("line", [(0, 1), (1, 2), (2, nan), (3, inf), (4, 1), (5, 2)])], "x", "y")
print(svg.count("<polyline"), "lines")
svg = chart("a", [Series("marks", [(0, 1), (nan, 2), (2, 3)], marks=True)], "x", "y")
print(svg.count("<circle"), "marks")
low, high = [(x, 0 if x != 2 else nan) for x in range(5)], [(x, 1) for x in range(5)]
svg = chart("a", [Series("band", low, band=high)], "x", "y")
print(svg.count("<polygon"), "areas;", "nan" in svg)
print(repr(chart("a", [Series("nothing", [(0, nan)])], "x", "y")), ticks(0, inf), ticks(nan, 1), ticks(0, 1, 3))
)");
  EXPECT_EQ(said, "2 lines\n2 marks\n2 areas; False\n'' [] [] [0.0, 0.5, 1.0]\ncode 0\n");
}

TEST(ReproductionFamily, curves_are_told_apart_without_their_colors) {
  const FamilyFolder folder;
  const std::string said = folder.python(R"(from charts import Series, chart, published
def signs(*series):
    svg = chart("a", series, "x", "y")
    return svg.count("<circle"), svg.count('class="sign"'), [svg.count(glyph) for glyph in "●■"]
points = [(x, x) for x in range(3)]
print(signs(Series("one", points)), signs(Series("one", points), Series("two", points), published("three", points)))
print(signs(Series("one", [(x, x) for x in range(100)]), Series("two", points)))
)");
  EXPECT_EQ(said, "(0, 0, [0, 1]) (3, 3, [1, 2])\n(6, 3, [1, 1])\ncode 0\n");
}

TEST(ReproductionFamily, the_two_edges_of_a_band_are_named_in_the_table) {
  const FamilyFolder folder;
  const std::string said = folder.python(R"(import publication
from charts import Series
page = publication.Page("out", "t", "a", "c")
page.chart("f", "t", "r", [Series("XPBD, passive", [(0, 1), (1, 2)], band=[(0, 3), (1, 4)]), Series("XPBD, passive", [(0, 2)])], "x", "y")
print(open("out/figures/f.csv").read())
print(open("out/figures/f.svg").read().count("■"), "in the legend")
)");
  EXPECT_THAT(said, HasSubstr("\"XPBD, passive (low)\",1,2\n\"XPBD, passive (high)\",0,3\n"));
  EXPECT_THAT(said, HasSubstr("\"XPBD, passive (high)\",1,4\n\"XPBD, passive\",0,2\n"));
  EXPECT_THAT(said, HasSubstr("1 in the legend"));
  EXPECT_THAT(said, Not(HasSubstr("\n,")));
}

}  // namespace gracilis
