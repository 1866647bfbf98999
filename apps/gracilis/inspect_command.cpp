#include "inspect_command.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/run/inspect.hpp>
#include <gracilis/io/run/inspect_data.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <iostream>
#include <memory>
#include <vector>

namespace gracilis {

/// Describes every file that can be read; throws at the end when there were others.
static int inspect(const std::vector<std::filesystem::path>& files, bool json, int slices) {
  nlohmann::ordered_json descriptions = nlohmann::json::array();
  std::vector<Problem> problems;
  for (const std::filesystem::path& file : files) {
    try {
      descriptions.push_back(inspect_file(file));
      if (slices > 0 && descriptions.back().at("kind") == "surface") {
        descriptions.back()["slices"] = inspect_slices(file, slices);
        if (!json)
          for (auto& slice : descriptions.back()["slices"]) slice.erase("outline_mm");
      }
      if (!json) std::cout << to_text(descriptions.back());
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (json) std::cout << json_text(descriptions);
  std::cout.flush();
  if (!problems.empty()) throw InputError(problems);
  return static_cast<int>(ExitCode::done);
}

void add_inspect_command(CLI::App& program, std::function<int()>& chosen) {
  struct Options {
    std::vector<std::filesystem::path> files;
    bool json = false;
    int slices = 0;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("inspect", "Say what is in files and run folders");
  command->add_option("FILE", options->files, "Surfaces, .mot, .sto, .csv, .osim, .toml or run folders")->required();
  command->add_flag("--json", options->json, "A list with one object per file, for programs");
  command
      ->add_option("--slices", options->slices,
                   "Of surfaces, also so many slices across the longest axis: area, perimeter, isoperimetric quotient")
      ->check(CLI::Range(1, 1000));
  command->callback(
      [&chosen, options] { chosen = [options] { return inspect(options->files, options->json, options->slices); }; });
}

}  // namespace gracilis
