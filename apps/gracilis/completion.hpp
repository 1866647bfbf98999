#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// A word that may stand where a command line ends, and what it means; the meaning may be empty.
struct Candidate {
  std::string word, meaning;
};

/// A command line as a shell splits it, so far as it goes; the last word is the one to complete, and may be empty.
std::vector<std::string> shell_words(const std::string& line);

/// What the last word of a command line may become, by the program's own tables, the files that are there, and the
/// scene, run or model that the line names. Throws nothing: where nothing is known there are none.
std::vector<Candidate> completions(const CLI::App& program, const std::string& line);

}  // namespace gracilis
