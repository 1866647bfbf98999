#include "verify_command.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/counted.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/run/verify_run.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace gracilis {

static ExitCode code_of(const Verification& result) {
  return result.findings.empty() ? ExitCode::done : ExitCode::unreadable_input;
}

static int print_json(const std::filesystem::path& run, const Verification& result) {
  const nlohmann::ordered_json found = {{"run", run.string()},
                                        {"status", result.status},
                                        {"frames", result.frames},
                                        {"files", result.files},
                                        {"findings", result.findings}};
  fmt::print("{}", json_text(found));
  return static_cast<int>(code_of(result));
}

static int verify(const std::filesystem::path& run, bool json) {
  const Verification result = verify_run(run);
  if (json) return print_json(run, result);
  for (const std::string& finding : result.findings) fmt::print("{}\n", finding);
  if (result.files == 0) spdlog::warn("a run that is {} has no hashes: only what it says was compared", result.status);
  if (!result.findings.empty()) {
    spdlog::error("{}: {} things are missing, changed or inconsistent", run.string(), result.findings.size());
    return static_cast<int>(code_of(result));
  }
  fmt::print("{}: {}, {}, {} as they were written\n", run.string(), result.status,
             counted(static_cast<std::size_t>(result.frames), "frame"),
             counted(static_cast<std::size_t>(result.files), "file"));
  return static_cast<int>(ExitCode::done);
}

void add_verify_command(CLI::App& program, Command& chosen) {
  struct Options {
    std::filesystem::path run;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "verify", "Tell what of a run is missing, has changed since it ended or contradicts itself (exit code 3)");
  command->add_option("RUN", options->run, "Run folder")->required();
  command->add_flag("--json", options->json, "Print JSON, for programs");
  command->callback([&chosen, options] { chosen = [options] { return verify(options->run, options->json); }; });
}

}  // namespace gracilis
