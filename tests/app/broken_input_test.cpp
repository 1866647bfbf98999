#include <build_paths.hpp>

#include "app/program.hpp"
#include "io/scene_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace gracilis {
namespace {

using testing::HasSubstr;
using testing::Not;

/// What the program says and leaves alone where files or its surroundings are not as they should be.
class BrokenInput : public testing::Test {
 protected:
  BrokenInput() { setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1); }

  ProgramResult run_of(const std::string& text) const {
    return run_program("run " + folder.write("scene.toml", text).string() + " --out " + folder.path("out").string());
  }
  std::string content(const std::string& name) const {
    std::stringstream text;
    text << std::ifstream(folder.path(name)).rdbuf();
    return text.str();
  }

  SceneFolder folder;
};

TEST_F(BrokenInput, of_a_thousand_problems_twenty_are_told) {
  std::string text = "schema = 1\n";
  for (int i = 0; i < 1000; ++i) text += "k" + std::to_string(i) + " = 1\n";
  const ProgramResult result = run_of(text);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 21) << result.err;
  EXPECT_THAT(result.err, testing::EndsWith(" more\n"));
}

TEST_F(BrokenInput, names_of_any_length_are_cut_in_messages) {
  const ProgramResult result = run_of(std::string(200'000, 'k') + " = 1\n" + good_scene());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_LT(result.err.size(), 10'000u);
}

TEST_F(BrokenInput, control_characters_do_not_reach_the_terminal) {
  const ProgramResult result = run_of("\"a\\u001b[31mb\\u009bc\" = 1\n" + good_scene());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("unknown key 'a?[31mb?c'"));
}

TEST_F(BrokenInput, with_stderr_closed_the_log_goes_into_no_file_of_the_run) {
  std::filesystem::create_directory(folder.path("out"));
  folder.write("kept", "");
  // The lock is removed at the end; another name of the same file shows what was written into it.
  std::filesystem::create_hard_link(folder.path("kept"), folder.path("out/run.lock"));
  const std::string scene = folder.write("scene.toml", good_scene()).string();
  EXPECT_THAT(said_by(std::string(build_paths::program) + " run " + scene + " --set iterations=3 --out " +
                      folder.path("out").string() + " 2>&-; echo exit $?"),
              testing::EndsWith("exit 0\n"));
  const std::string lock = content("kept");
  EXPECT_EQ(std::count(lock.begin(), lock.end(), '\n'), 1) << lock;
  EXPECT_THAT(lock, Not(HasSubstr("frame")));
}

TEST_F(BrokenInput, with_stdout_closed_what_is_printed_is_lost_and_told_of) {
  const std::string program = build_paths::program;
  EXPECT_THAT(said_by(program + " --version >&-; echo exit $?"), testing::EndsWith("exit 3\n"));
  EXPECT_THAT(said_by(program + " --version <&- >/dev/null; echo exit $?"), testing::EndsWith("exit 0\n"));
}

TEST_F(BrokenInput, a_file_may_be_asked_for_in_a_folder_that_is_not_there) {
  ASSERT_EQ(run_of(good_scene()).exit_code, 0);
  const std::string run = folder.path("out").string();
  for (const std::string& command : {"report " + run + " --out ", "export " + run + " --to usd --vertices 50 --out ",
                                    "new " + folder.path("muscle.ply").string() + " --out "}) {
    const std::string name = command.starts_with("new")      ? "new.toml"
                             : command.starts_with("export") ? "run.usda"
                                                             : "report.html";
    const ProgramResult result = run_program(command + folder.path("not/there/" + name).string());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(std::filesystem::exists(folder.path("not/there/" + name)));
    std::filesystem::remove_all(folder.path("not"));
  }
}

TEST_F(BrokenInput, a_new_scene_replaces_no_file_beside_it_unasked) {
  for (const std::string name : {"my_landmarks.csv", "my.png"}) {
    folder.write(name, "mine");
    const std::string command = "new " + folder.path("none.ply").string() + " --out " + folder.path("my.toml").string();
    const ProgramResult result = run_program(command);
    EXPECT_EQ(result.exit_code, 2) << name;
    EXPECT_THAT(result.err, HasSubstr(name + ": is there already"));
    EXPECT_EQ(content(name), "mine");
    EXPECT_EQ(run_program(command + " --force").exit_code, 3) << "the surface is not there";
    std::filesystem::remove(folder.path(name));
  }
}

}  // namespace
}  // namespace gracilis
