#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// What to do first, for who starts the program without a word.
std::string first_steps();

/// Adds an example to the help of every command.
void add_examples(CLI::App& program);

/// What is wrong with a command line that the program did not take, with what was probably meant.
std::string usage_problem(const CLI::App& program, const CLI::ParseError& error, const std::vector<std::string>& words);

}  // namespace gracilis
