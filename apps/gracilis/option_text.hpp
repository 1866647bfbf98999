#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// The values that an option takes where it takes only some; empty: any.
std::vector<std::string> choices_of(const CLI::Option& option);

/// What stands behind an option's name: "INT in [0 - 1024]", "full|light|none", with its default; empty for switches.
std::string value_text(const CLI::Option& option);

/// Options by their names alone, without positional arguments; those that are not shown are left out.
std::vector<const CLI::Option*> named_options(const CLI::App& command);
std::vector<const CLI::Option*> positional_arguments(const CLI::App& command);

/// Help that names choices by their names alone.
class HelpText : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override;
};

}  // namespace gracilis
