#include "verify_command.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/run/verify_run.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace gracilis {

static int verify(const std::filesystem::path& run) {
  const Verification result = verify_run(run);
  for (const std::string& finding : result.findings) fmt::print("{}\n", finding);
  if (result.files == 0) spdlog::warn("a run that is {} has no hashes: only what it says was compared", result.status);
  if (!result.findings.empty()) {
    spdlog::error("{}: {} things are missing, changed or inconsistent", run.string(), result.findings.size());
    return static_cast<int>(ExitCode::unreadable_input);
  }
  fmt::print("{}: {}, {} frames, {} files as they were written\n", run.string(), result.status, result.frames,
             result.files);
  return static_cast<int>(ExitCode::done);
}

void add_verify_command(CLI::App& program, Command& chosen) {
  const auto run = std::make_shared<std::filesystem::path>();
  CLI::App* command = program.add_subcommand(
      "verify", "Tell what of a run is missing, has changed since it ended or contradicts itself (exit code 3)");
  command->add_option("RUN", *run, "Run folder")->required();
  command->callback([&chosen, run] { chosen = [run] { return verify(*run); }; });
}

}  // namespace gracilis
