#pragma once

#include <gracilis/io/input_file.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <sstream>
#include <string>

namespace gracilis {

/// What a run left, by file, without times and what tells of the process: all that a resumed run must have, bit by bit.
inline std::map<std::string, std::string> left_in(const std::filesystem::path& run) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(run)) {
    const std::string name = std::filesystem::relative(entry.path(), run).string();
    if (!entry.is_regular_file() || name == "outputs.sha256") continue;  // has the hash of the table with times
    std::string& text = files[name] = read_text(entry.path());
    if (name == "measures.csv") {  // the last column has milliseconds
      std::istringstream lines(text);
      text.clear();
      for (std::string line; std::getline(lines, line);) text += line.substr(0, line.rfind(',')) + "\n";
    }
    if (name == "run.json") {
      nlohmann::ordered_json manifest = nlohmann::ordered_json::parse(text);
      for (const char* key : {"command", "written", "seconds", "outputs_sha256"}) manifest.erase(key);
      text = manifest.dump(1);
    }
  }
  return files;
}

}  // namespace gracilis
