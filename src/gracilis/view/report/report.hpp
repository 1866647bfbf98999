#pragma once

#include <gracilis/io/run/recorded_run.hpp>

#include <filesystem>
#include <vector>

namespace gracilis {

/// One HTML file that shows and explains one run, or several beside each other: a view in three dimensions that turns
/// and plays, plots, quality gates, warnings, settings and provenance. It needs nothing but itself.
struct ReportOptions {
  std::size_t shape_bytes = 8'000'000;  ///< at most, of all shapes together, before they become text (4/3 as long)
};

/// Writes it, whole or not at all. Precondition: at least one run. Throws InputError when a frame is damaged or the
/// file cannot be written.
void write_report(const std::filesystem::path& path, const std::vector<RecordedRun>& runs,
                  const ReportOptions& options = {});

}  // namespace gracilis
