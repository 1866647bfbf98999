#include "report_command.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/view/report/report.hpp>

#include <fmt/format.h>

#include <memory>

namespace gracilis {

void add_report_command(CLI::App& program, Command& chosen) {
  struct Options {
    std::vector<std::filesystem::path> runs;
    std::filesystem::path out;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("report", "Explain runs in one HTML file that needs nothing but a browser");
  command->add_option("RUN", options->runs, "Run folders; several are compared, the first leads")->required();
  command->add_option("--out", options->out, "File to write (default: report.html in the first run's folder)")
      ->allow_extra_args(false);
  command->callback([&chosen, options] {
    chosen = [options] {
      std::vector<RecordedRun> runs;
      for (const std::filesystem::path& folder : options->runs) runs.push_back(open_recorded_run(folder));
      const std::filesystem::path out = options->out.empty() ? options->runs[0] / "report.html" : options->out;
      write_report(out, runs);
      fmt::print("{}\n", out.string());
      return static_cast<int>(ExitCode::done);
    };
  });
}

}  // namespace gracilis
