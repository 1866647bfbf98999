#include "report_command.hpp"

#include "run_scene.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/view/report/live_page.hpp>
#include <gracilis/view/report/report.hpp>

#include <fmt/format.h>

#include <memory>

namespace gracilis {

namespace {

struct Options {
  std::vector<std::filesystem::path> runs;
  std::filesystem::path out, page;
  bool live = false;
};

/// The page of the built-in hip: in a build beside the folder of programs, installed among what belongs to this one.
std::filesystem::path usual_page() {
  const std::filesystem::path programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const std::filesystem::path built = programs.parent_path() / "gracilis.html",
                              installed = programs.parent_path() / "share" / "gracilis" / "gracilis.html";
  for (const std::filesystem::path& page : {built, installed})
    if (is_there(page)) return page;
  throw ConfigurationError({"--live", "", "there is no page for the browser beside this program",
                            "build it with `ninja -C build/release gracilis_web`, or name one with --page"});
}

/// Returns the file that it writes.
std::filesystem::path write_live(const Options& options, const std::filesystem::path& report) {
  std::filesystem::path out = report.parent_path() / "live.html",
                        page = options.page.empty() ? usual_page() : options.page;
  write_live_page(out, page, scene_of_run(options.runs[0]).scene);
  return out;
}

}  // namespace

void add_report_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("report", "Explain runs in one HTML file that needs nothing but a browser");
  command->add_option("RUN", options->runs, "Run folders; several are compared, the first leads")->required();
  command->add_option("--out", options->out, "File to write (default: report.html in the first run's folder)")
      ->allow_extra_args(false);
  CLI::Option* live = command->add_flag(
      "--live", options->live,
      "Also write live.html beside it: the first run's scene in a page that moves it, with the solver inside");
  command
      ->add_option("--page", options->page, "gracilis.html to put the scene into (default: the one built or installed)")
      ->needs(live)
      ->allow_extra_args(false);
  command->callback([&chosen, options] {
    chosen = [options] {
      std::vector<RecordedRun> runs;
      for (const std::filesystem::path& folder : options->runs) runs.push_back(open_recorded_run(folder));
      const std::filesystem::path out = options->out.empty() ? options->runs[0] / "report.html" : options->out;
      create_folder_of(out);
      // The live page first: where there is no page or no scene any more, nothing is written.
      const std::filesystem::path page = options->live ? write_live(*options, out) : "";
      write_report(out, runs);
      fmt::print("{}\n", out.string());
      if (options->live) fmt::print("{}\n", page.string());
      return static_cast<int>(ExitCode::done);
    };
  });
}

}  // namespace gracilis
