#include "app/program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace gracilis {

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

bool has_program(const std::string& name) { return !said_by("command -v " + name).empty(); }

/// The manual as the program writes it, made once.
const fs::path& manual_folder() {
  static const fs::path folder = [] {
    fs::path made = fs::temp_directory_path() / ("gracilis_manual_" + std::to_string(getpid()));
    const ProgramResult result = run_program("manual " + made.string());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::atexit([] { fs::remove_all(manual_folder()); });
    return made;
  }();
  return folder;
}

std::string manual_page(const std::string& name) {
  std::ifstream file(manual_folder() / name);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Words of a text alone: how lines break and what stands bold is up to man.
std::string words_only(const std::string& text) {
  std::string words;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c))) words += c;
  return words;
}

}  // namespace

/// What a command's help lists as commands below it.
static std::vector<std::string> commands_below(const std::string& command) {
  std::istringstream lines(run_program(command + " --help").out);
  for (std::string line; std::getline(lines, line) && line != "Subcommands:";) {
  }
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line) && !line.empty();)
    if (line.size() > 2 && line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

TEST(Manual, every_command_that_help_lists_has_a_page_with_all_its_options) {
  std::map<std::string, std::string> pages = {{"gracilis.1", ""}};  // and the command that each is about
  for (const std::string& command : commands_below("")) {
    pages["gracilis-" + command + ".1"] = command;
    for (const std::string& below : commands_below(command))
      pages["gracilis-" + command + "-" + below + ".1"] = command + " " + below;
  }
  ASSERT_GT(pages.size(), 20U);
  ASSERT_EQ(pages.count("gracilis-activations-join.1"), 1U);
  for (const auto& [name, command] : pages) {
    const std::string text = manual_page(name);
    ASSERT_NE(text, "") << name;
    const std::string help = run_program(command + " --help").out;
    const std::regex option("\n +(?:-.,)?(--[a-z-]+)");
    for (std::sregex_iterator each(help.begin(), help.end(), option), end; each != end; ++each)
      EXPECT_THAT(words_only(text), HasSubstr(words_only((*each)[1]))) << name;
    EXPECT_THAT(text, HasSubstr(".SH EXAMPLES")) << name;
  }
  std::set<std::string> written, expected;
  for (const auto& [name, command] : pages) expected.insert(name);
  for (const fs::directory_entry& entry : fs::directory_iterator(manual_folder()))
    written.insert(entry.path().filename());
  EXPECT_EQ(written, expected);
}

TEST(Manual, commands_that_say_more_than_the_name_of_a_file_say_it_as_json_too) {
  // What they print is the name of one file that they wrote, a scene (.toml), or nothing.
  const std::set<std::string> name_files = {"print-config", "render", "report", "study report", "view"};
  std::set<std::string> without;
  for (const std::string& command : commands_below("")) {
    const std::vector<std::string> below = commands_below(command);
    for (const std::string& each : below)
      if (run_program(command + " " + each + " --help").out.find("--json") == std::string::npos)
        without.insert(command + " " + each);
    if (below.empty() && run_program(command + " --help").out.find("--json") == std::string::npos)
      without.insert(command);
  }
  EXPECT_EQ(without, name_files);
}

TEST(Manual, no_sentence_of_a_page_ends_with_two_full_stops) {
  for (const fs::directory_entry& page : fs::directory_iterator(manual_folder()))
    EXPECT_FALSE(std::regex_search(manual_page(page.path().filename().string()), std::regex("[a-z)][.][.]\n")))
        << page.path();
}

TEST(Manual, man_has_nothing_to_warn_about) {
  const bool mandoc = has_program("mandoc");
  if (!mandoc && !has_program("man")) GTEST_SKIP() << "neither mandoc nor man is installed";
  std::string command = "cd " + manual_folder().string() + " && for page in *.1; do ";
  command += mandoc ? "mandoc -Tlint -W warning $page; done" : "man --warnings -E UTF-8 -l $page 2>&1 >/dev/null; done";
  EXPECT_EQ(said_by(command + "\necho \"exit $?\""), "exit 0\n");
}

TEST(Manual, a_folder_that_cannot_be_made_is_an_error) {
  EXPECT_EQ(run_program("manual /dev/null/manual").exit_code, 3);
}

TEST(Version, tells_commit_compiler_instruction_sets_and_components) {
  const ProgramResult text = run_program("--version");
  for (const char* word : {"gracilis 0.", "commit ", "compiler ", "instruction sets ", "in use ", "components "})
    EXPECT_THAT(text.out, HasSubstr(word));
  for (const char* arguments : {"--version --json", "--json --version"}) {
    const nlohmann::json json = nlohmann::json::parse(run_program(arguments).out);
    EXPECT_THAT(text.out, HasSubstr("gracilis " + json.at("version").get<std::string>() + "\n"));
    EXPECT_TRUE(std::regex_match(json.at("commit").get<std::string>(), std::regex("unknown|[0-9a-f]{7,}(, changed)?")));
    const auto sets = json.at("instruction_sets").get<std::vector<std::string>>();
    EXPECT_NE(std::find(sets.begin(), sets.end(), json.at("instruction_set")), sets.end());
    EXPECT_EQ(json.at("components").size() + json.at("not_built").size(), 2U);
  }
  EXPECT_EQ(run_program("--json").exit_code, 2);
}

}  // namespace gracilis
