#pragma once

#include <gracilis/io/input_file.hpp>

#include "app/program.hpp"
#include "io/test_files.hpp"
#include "view/walk_files.hpp"

#include <build_paths.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace gracilis {

/// Commands of a page, typed one after the other. A comment above them, which no reader sees, says how they are walked:
/// `<!-- walk: SCENE -> hip.toml; DIR -> out -->` puts these words in the place of those; `long` leaves them to the
/// long tests, `data` to those, too, where the cadaver's hip is at hand; `page` to where there is one for the browser;
/// `not, REASON` to nobody.
struct CommandBlock {
  std::string place;               ///< page and line
  std::vector<std::string> marks;  ///< of the comment, that were parted by "; "
  std::string text;

  bool says(const std::string& mark) const { return std::find(marks.begin(), marks.end(), mark) != marks.end(); }
  bool is_left_out() const { return !marks.empty() && marks.front().starts_with("not, "); }
  std::string file() const {
    return !marks.empty() && marks.front().starts_with("file ") ? marks.front().substr(5) : "";
  }
};

inline bool is_command(const std::string& line) {
  return line.starts_with("gracilis ") || line.starts_with("build/release/bin/gracilis ");
}

inline std::vector<std::string> parted(std::string text, const std::string& separator) {
  std::vector<std::string> parts;
  for (std::size_t end; (end = text.find(separator)) != std::string::npos; text = text.substr(end + separator.size()))
    parts.push_back(text.substr(0, end));
  parts.push_back(text);
  return parts;
}

/// The blocks of code of a page that hold a command.
inline std::vector<CommandBlock> command_blocks(const std::string& name, const std::string& page) {
  std::vector<CommandBlock> found;
  CommandBlock block;
  std::vector<std::string> marks;
  bool fenced = false, inside = false, any = false;
  const auto close = [&] {
    if (any) found.push_back(block);
    if (inside) marks.clear();
    inside = any = false;
  };
  std::istringstream lines(page);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const bool fence = line.starts_with("```");
    if (fence && fenced) close();
    if (fence) fenced = !fenced;
    const bool code = !fence && (fenced || line.starts_with("    "));
    if (!code && !fence && !line.empty()) close();
    if (line.starts_with("<!-- walk: ")) marks = parted(line.substr(11, line.rfind(" -->") - 11), "; ");
    if (!code) continue;
    if (!inside) block = {name + ":" + std::to_string(number), marks, ""};
    inside = true;
    const std::string typed = fenced ? line : line.substr(4);
    any |= is_command(typed) || !block.file().empty();
    block.text += typed + "\n";
  }
  close();
  return found;
}

/// README.md and all pages below docs.
inline std::map<std::string, std::string> manual_pages() {
  const std::filesystem::path root = build_paths::source_folder;
  std::map<std::string, std::string> pages = {{"README.md", read_text(root / "README.md")}};
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md")
      pages[entry.path().lexically_relative(root).string()] = read_text(entry.path());
  return pages;
}

inline std::vector<CommandBlock> blocks_of_manual() {
  std::vector<CommandBlock> all;
  for (const auto& [name, text] : manual_pages()) {
    if (name == "README.md") continue;  // has a walk of its own
    const std::vector<CommandBlock> blocks = command_blocks(name, text);
    all.insert(all.end(), blocks.begin(), blocks.end());
  }
  return all;
}

/// What of a block the shell is to do.
inline std::string typed_text(const CommandBlock& block) {
  std::string text = std::regex_replace(block.text, std::regex("build/release/bin/gracilis"), "gracilis");
  for (const std::string& mark : block.marks) {
    const std::size_t arrow = mark.find(" ->");
    if (arrow == std::string::npos) continue;
    const std::string from = mark.substr(0, arrow), to = mark.substr(std::min(mark.size(), arrow + 4));
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  }
  return text;
}

/// Types a block in a folder, as `bash -e` does.
inline void walk(const CommandBlock& block, const std::filesystem::path& folder) {
  if (!block.file().empty()) {
    std::ofstream(folder / block.file()) << block.text;
    return;
  }
  const std::filesystem::path script = folder / "walk.sh", said = folder / "said.txt";
  std::ofstream(script) << "set -e\ngracilis() { '" << build_paths::program << "' \"$@\"; }\n" << typed_text(block);
  const int status =
      std::system(("cd '" + folder.string() + "' && bash walk.sh </dev/null >'" + said.string() + "' 2>&1").c_str());
  EXPECT_EQ(status, 0) << block.place << "\n" << typed_text(block) << "\n" << read_text(said);
}

/// The folder that pages are copied from: scenes, a run in out/demo, and what write_walk_files adds.
inline void make_walk_files(const std::filesystem::path& files) {
  std::filesystem::create_directories(files);
  std::filesystem::copy(std::filesystem::path(build_paths::source_folder) / "scenes", files / "scenes",
                        std::filesystem::copy_options::recursive);
  walk({"the demo that pages are given",
        {},
        "gracilis demo --flexion 4 --only adductor_longus_r --set method=skinning --out out/demo\n"},
       files);
  write_walk_files(files);
}

/// Walks those blocks that are wanted, each page in a folder of its own with the files that all need.
template <class Wanted>
int walk_manual(const TestFolder& folder, const Wanted& wanted) {
  std::map<std::string, std::vector<CommandBlock>> pages;
  for (const CommandBlock& block : blocks_of_manual())
    if (!block.is_left_out() && (!block.file().empty() || wanted(block)))
      pages[block.place.substr(0, block.place.find(':'))].push_back(block);
  const std::filesystem::path files = folder.path() / "files";
  make_walk_files(files);
  int walked = 0;
  for (const auto& [page, blocks] : pages) {
    const std::filesystem::path here = folder.path() / std::filesystem::path(page).stem();
    std::filesystem::copy(files, here, std::filesystem::copy_options::recursive);
    for (const CommandBlock& block : blocks) {
      walk(block, here);
      walked += block.file().empty();
    }
  }
  return walked;
}

}  // namespace gracilis
