#include <gracilis/simulate/gates.hpp>
#include <gracilis/simulate/measures.hpp>

#include <build_paths.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

/// docs/guide/when-it-looks-wrong.md explains what the program says, in its words.
namespace gracilis {

namespace {

namespace fs = std::filesystem;

const fs::path root = build_paths::source_folder;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string page() { return text_of(root / "docs/guide/when-it-looks-wrong.md"); }

/// All sources, with literals that go over several lines put together.
std::string sources() {
  std::string all;
  for (const char* folder : {"src", "apps"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.path().extension() == ".cpp") all += text_of(entry.path());
  std::string joined;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t next = all[i] == '"' ? all.find_first_not_of(" \n", i + 1) : std::string::npos;
    if (next != std::string::npos && next > i + 1 && all[next] == '"' &&
        all.substr(i, next - i).find('\n') != std::string::npos)
      i = next;
    else
      joined += all[i];
  }
  return joined;
}

/// The fixed words of a message whose names and numbers are left out.
std::vector<std::string> fixed_words(const std::string& message) {
  static const std::regex gap(" *(…|, ) *");
  const std::sregex_token_iterator begin(message.begin(), message.end(), gap, -1);
  std::vector<std::string> words;
  for (auto each = begin; each != std::sregex_token_iterator(); ++each)
    if (!each->str().empty()) words.push_back(*each);
  return words;
}

}  // namespace

TEST(WarningsPage, headings_and_tables_quote_the_program) {
  const std::string said = sources(), text = page();
  std::vector<std::string> quotes;
  const std::regex heading("\n### ([^\n]*)");
  for (std::sregex_iterator each(text.begin(), text.end(), heading), end; each != end; ++each)
    for (const std::string& words : fixed_words((*each)[1])) quotes.push_back(words);
  // In tables of messages, what stands between backquotes in the column of messages.
  std::istringstream lines(text);
  bool messages = false;
  std::size_t column = 1;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("| message")) messages = true, column = 1;
    if (line.starts_with("| command | message")) messages = true, column = 2;
    if (!line.starts_with("|")) messages = false;
    if (!messages) continue;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < column; ++i) begin = line.find('|', begin) + 1;
    const std::string cell = line.substr(begin, line.find('|', begin) - begin);
    static const std::regex quoted("`([^`]*)`");
    for (std::sregex_iterator each(cell.begin(), cell.end(), quoted), end; each != end; ++each)
      quotes.push_back((*each)[1]);
  }
  EXPECT_GT(quotes.size(), 60U);
  for (const std::string& words : quotes) EXPECT_NE(said.find(words), std::string::npos) << words;
}

TEST(WarningsPage, every_gate_stands_there_with_why_it_matters) {
  MuscleMeasures bad;
  bad.finite = false;
  bad.volume_ratio = 2;
  bad.vertex_depth_beyond_rest = bad.midpoint_depth_beyond_rest = bad.belly_off_place = 1;
  bad.muscle_depth_beyond_rest = 1;
  bad.edge_ratio_max_free = bad.edge_ratio_max_near = bad.spike = bad.thickening = bad.thinning = 100;
  bad.wrong_side = bad.slack = 1;
  const std::vector<MissedGate> missed = gates_missed_by(bad, QualityGates{});
  EXPECT_EQ(missed.size(), 13U);
  const std::string text = page();
  for (const MissedGate& gate : missed)
    EXPECT_NE(text.find("\"" + gate.consequence + "\""), std::string::npos) << gate.text;
}

}  // namespace gracilis
