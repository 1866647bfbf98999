#include <gracilis/io/run/output_hashes.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/content_hash.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/value_reader.hpp>

#include <algorithm>

namespace gracilis {

namespace fs = std::filesystem;

std::string output_hash(const fs::path& file) { return content_hash_of(text_if_there(file)); }

std::vector<OutputHash> hash_outputs(const fs::path& folder) {
  std::vector<OutputHash> outputs;
  for (const char* file : {"fiber_lengths.sto", "forces.sto", "measures.csv", "paraview.py", "preview.png", "run.pvd"})
    if (is_there(folder / file)) outputs.push_back({file, ""});
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool is_table = name.starts_with("moment_arms_") || name.starts_with("lines_of_action");
    if (is_table && name.ends_with(".sto") && entry.is_regular_file()) outputs.push_back({name, ""});
  }
  for (const std::string part : {"bones", "fibers", "frames", "plots", "shapes"}) {
    if (!is_there(folder / part)) continue;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / part)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with('.') && entry.is_regular_file()) outputs.push_back({part + "/" + name, ""});
    }
  }
  std::sort(outputs.begin(), outputs.end(), [](const auto& a, const auto& b) { return a.file < b.file; });
  parallel_for_each(outputs.size(), [&](std::size_t i) { outputs[i].sha256 = output_hash(folder / outputs[i].file); });
  return outputs;
}

std::string write_output_hashes(const fs::path& folder) {
  std::string text;
  for (const OutputHash& output : hash_outputs(folder)) text += output.sha256 + "  " + output.file + "\n";
  write_text_atomically(folder / output_hashes_name, text);
  return content_hash_of(text);
}

/// A run's list names what lies in its folder, whoever wrote it.
static bool stays_inside(const fs::path& file) {
  return !file.empty() && file.is_relative() &&
         std::none_of(file.begin(), file.end(), [](const fs::path& part) { return part == ".."; });
}

std::vector<OutputHash> read_output_hashes(const fs::path& folder) {
  const fs::path path = folder / output_hashes_name;
  const std::string text = read_text(path);
  ValueReader reader(path, text);
  std::vector<OutputHash> outputs;
  while (!reader.at_end()) {
    const std::string_view line = reader.line();
    if (line.size() < 67 || line.substr(64, 2) != "  " || !stays_inside(line.substr(66)))
      reader.fail("is no line of a list of hashes", "run the scene again");
    outputs.push_back({std::string(line.substr(66)), std::string(line.substr(0, 64))});
  }
  return outputs;
}

}  // namespace gracilis
