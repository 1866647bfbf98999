#pragma once

#include "command.hpp"

#include <string>
#include <vector>

namespace gracilis {

/// What packages and shells ask of the program, and no help lists: `manual FOLDER` writes its pages for man(1),
/// `complete LINE` prints a line per word that may stand at the end of a command line, with a tab before what it means.
/// Empty: the words ask for neither. The program must outlive the command.
Command hidden_command(const CLI::App& program, const std::vector<std::string>& words);

}  // namespace gracilis
