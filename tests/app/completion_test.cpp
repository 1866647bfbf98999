#include "app/program.hpp"
#include "io/test_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace gracilis {

namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

}  // namespace

/// A folder with a scene, what it includes, a run and other files.
class Completion : public testing::Test {
 protected:
  void SetUp() override {
    write("base.toml",
          "[[muscles]]\nname = \"psoas_r\"\n[[muscles]]\nname = \"iliacus_r\"\n"
          "[[joints]]\nname = \"hip_r\"\n[[joints.axes]]\ncoordinate = \"hip_flexion_r\"\n");
    write("leg.toml", "include = \"base.toml\"\n[[muscles]]\nname = \"sartorius_r\"\n");
    write("my scene.toml", "");
    write("notes.txt", "");
    write("walk.sto", "");
    fs::create_directories(folder_ / "done");
    write("done/run.json", "{}");
    fs::create_directories(folder_ / "drafts");
  }

  void write(const std::string& name, const std::string& text) const { test_folder_.write(name, text); }

  std::string said_here(const std::string& command) const {
    return said_by("cd '" + folder_.string() + "' && " + command);
  }

  std::vector<std::string> lines_of(const std::string& text, bool first_column) const {
    std::vector<std::string> all;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      all.push_back(first_column ? line.substr(0, line.find('\t')) : line);
    return all;
  }

  std::string quoted(const std::string& line) const { return "\"" + line + "\""; }

  std::vector<std::string> words(const std::string& line) const {
    return lines_of(said_here(std::string(build_paths::program) + " complete " + quoted(line)), true);
  }

  /// What bash puts into the line, by its own variables.
  std::vector<std::string> in_bash(const std::string& line) const {
    std::ofstream(folder_ / "try.sh")
        << "PATH=" << fs::path(build_paths::program).parent_path().string() << ":$PATH\n"
        << "source " << build_paths::source_folder << "/apps/gracilis/completions/gracilis.bash\n"
        << "COMP_LINE='" << line
        << "'; COMP_POINT=${#COMP_LINE}\n"
        // As readline: words end at blanks, and at '=' and ':', which are words themselves.
        << "IFS=$'\\n' read -r -d '' -a COMP_WORDS < <(sed -E "
           "'s/([=:]+)/\\n\\1\\n/g; s/[ ]+/\\n/g' <<<\"$COMP_LINE\" | sed '1!{$!{/^$/d}}')\n"
        << "[[ $COMP_LINE == *[\" =:\"] ]] && [[ ${COMP_WORDS[-1]} != [=:] ]] && COMP_WORDS+=('')\n"
        << "COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_gracilis gracilis\n"
        << "printf '%s\\n' \"${COMPREPLY[@]}\"\n";
    fs::path script = folder_ / "try.sh";
    return lines_of(said_here("bash " + script.string()), false);
  }

  TestFolder test_folder_;
  fs::path folder_ = test_folder_.path();
};

TEST_F(Completion, commands_and_options_come_from_the_tables_of_help) {
  EXPECT_THAT(words("gracilis ru"), ElementsAre("run"));
  EXPECT_THAT(words("gracilis "), Contains("static-optimization"));
  EXPECT_THAT(words("gracilis "), Not(Contains("complete")));
  EXPECT_THAT(words("gracilis activations "), ElementsAre("join", "neighbors"));
  EXPECT_THAT(words("gracilis run --no-"), ElementsAre("--no-ramp", "--no-fibers", "--no-pictures"));
  EXPECT_THAT(words("gracilis run leg.toml --metrics "), ElementsAre("full", "light", "none"));
  EXPECT_THAT(words("gracilis run leg.toml --metrics=l"), ElementsAre("--metrics=light"));
  EXPECT_THAT(words("gracilis demo "), ElementsAre("hip", "elbow"));
}

TEST_F(Completion, settings_of_the_demo_are_those_that_it_takes) {
  const std::string complete = std::string(build_paths::program) + " complete ";
  EXPECT_THAT(said_here(complete + "'gracilis demo --set'"), Not(HasSubstr("motion.KEY")));
  EXPECT_THAT(said_here(complete + "'gracilis run --set'"), HasSubstr("motion.KEY"));
}

TEST_F(Completion, a_flag_takes_no_word) {
  EXPECT_THAT(words("gracilis run leg.toml --no-ramp --no-f"), ElementsAre("--no-fibers"));
  EXPECT_THAT(words("gracilis run --no-ramp l"), ElementsAre("leg.toml"));
  EXPECT_THAT(words("gracilis run --no-ramp leg.toml --metrics f"), ElementsAre("full"));
}

TEST_F(Completion, files_are_those_that_an_argument_takes) {
  EXPECT_THAT(words("gracilis run "), ElementsAre("base.toml", "done/", "drafts/", "leg.toml", "my scene.toml"));
  EXPECT_THAT(words("gracilis report d"), ElementsAre("done", "drafts/"));
  EXPECT_THAT(words("gracilis paths model.osim --motion w"), ElementsAre("walk.sto"));
  EXPECT_THAT(words("gracilis compare l"), ElementsAre("leg.toml"));
  EXPECT_THAT(words("gracilis compare de"), ElementsAre("demo", "demo-elbow"));
}

TEST_F(Completion, names_are_those_of_the_scene_and_all_that_it_includes) {
  EXPECT_THAT(words("gracilis run leg.toml --only "),
              testing::UnorderedElementsAre("psoas_r", "iliacus_r", "sartorius_r"));
  EXPECT_THAT(words("gracilis run leg.toml --only psoas_r,il"), ElementsAre("psoas_r,iliacus_r"));
  EXPECT_THAT(words("gracilis rom leg.toml --coord "), ElementsAre("hip_flexion_r="));
  EXPECT_THAT(words("gracilis demo elbow --only bi"), Contains(StartsWith("bi")));
  EXPECT_THAT(words("gracilis run no_such.toml --only "), IsEmpty());
}

TEST_F(Completion, settings_have_their_defaults_and_those_of_one_muscle) {
  const std::string said =
      said_here(std::string(build_paths::program) + " complete 'gracilis run leg.toml --set iterations'");
  EXPECT_THAT(said, HasSubstr("iterations=\tdefault "));
  EXPECT_THAT(words("gracilis run leg.toml --set iterations="), Contains(StartsWith("iterations=")));
  EXPECT_THAT(words("gracilis run leg.toml --set psoas_r.distance_sti"), ElementsAre("psoas_r.distance_stiffness="));
  EXPECT_THAT(words("gracilis run leg.toml --set method=sk"), ElementsAre("method=skinning"));
  EXPECT_THAT(words("gracilis run leg.toml --set method=tissue --set tension_fr"), ElementsAre("tension_frames="));
}

TEST_F(Completion, bash_completes_what_it_takes_for_a_word) {
  EXPECT_THAT(in_bash("gracilis ru"), ElementsAre("run"));
  EXPECT_THAT(in_bash("gracilis run leg.toml --set method=sk"), ElementsAre("skinning"));
  EXPECT_THAT(in_bash("gracilis run my"), ElementsAre("my\\ scene.toml"));
  EXPECT_THAT(in_bash("gracilis run --metrics="), ElementsAre("full", "light", "none"));
}

TEST_F(Completion, fish_and_zsh_take_their_scripts) {
  const std::string scripts = std::string(build_paths::source_folder) + "/apps/gracilis/completions/";
  const std::string path = "PATH=" + fs::path(build_paths::program).parent_path().string() + ":$PATH ";
  bool any = false;
  if (std::system("command -v fish >/dev/null") == 0) {
    any = true;
    EXPECT_THAT(said_here(path + "HOME=. fish --no-config -c 'source " + scripts +
                          "gracilis.fish; complete -C \"gracilis ru\"'"),
                StartsWith("run\tRun a scene"));
  }
  if (std::system("command -v zsh >/dev/null") == 0) {
    any = true;
    EXPECT_EQ(said_here("zsh -n " + scripts + "_gracilis"), "");
  }
  if (!any) GTEST_SKIP() << "neither fish nor zsh is installed";
}

}  // namespace gracilis
