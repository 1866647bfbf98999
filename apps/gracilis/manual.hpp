#pragma once

#include <CLI/CLI.hpp>

#include <filesystem>
#include <map>
#include <string>

namespace gracilis {

/// A page for man(1) of the program and one of each command, by their files' names ("gracilis-run.1"). What they say is
/// what `--help` says. `date` is that of the program, year first; empty: none is named.
std::map<std::string, std::string> manual_pages(const CLI::App& program, const std::string& version,
                                                const std::string& date);

/// Writes them into a folder. Throws InputError where that fails.
void write_manual(const CLI::App& program, const std::string& version, const std::string& date,
                  const std::filesystem::path& folder);

}  // namespace gracilis
