#include <gracilis/io/run/verify_run.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/io/content_hash.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/run/output_hashes.hpp>
#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/simulate/gates.hpp>

#include <fmt/format.h>

#include <cmath>

namespace gracilis {

namespace fs = std::filesystem;

/// measures.csv has six decimals of a ratio.
static constexpr Real ratio_tolerance = 1e-6;
/// fiber_lengths.sto has nine digits of a length.
static constexpr Real length_tolerance = 1e-8;

static void compare_hashes(const RecordedRun& run, Verification& result) {
  const fs::path list = run.folder / output_hashes_name;
  const auto sealed = run.manifest.find("outputs_sha256");
  if (sealed == run.manifest.end()) {
    if (result.status == "complete") result.findings.push_back("run.json has no hash of the run's files");
    return;
  }
  if (!is_there(list)) {
    result.findings.push_back(std::string(output_hashes_name) + " is missing");
    return;
  }
  if (*sealed != content_hash(list)) result.findings.push_back(std::string(output_hashes_name) + " has changed");
  const std::vector<OutputHash> outputs = read_output_hashes(run.folder);
  std::vector<std::string> findings(outputs.size());
  parallel_for_each(outputs.size(), [&](std::size_t i) {
    try {
      const fs::path file = run.folder / outputs[i].file;
      if (!is_there(file))
        findings[i] = outputs[i].file + " is missing";
      else if (output_hash(file) != outputs[i].sha256)
        findings[i] = outputs[i].file + " has changed";
    } catch (const InputError& error) {
      findings[i] = error.what();
    }
  });
  result.files = outputs.size();
  for (std::string& finding : findings)
    if (!finding.empty()) result.findings.push_back(std::move(finding));
}

/// Every muscle's volume in every frame over that in frame 0, against the column of measures.csv.
static void compare_volumes(const RecordedRun& run, Verification& result) {
  const Eigen::MatrixXd measured = measure_of(run, "volume_ratio");
  if (measured.size() == 0) return;
  const bool is_unmeasured = run.manifest.value("metrics", "full") == name_of(MeasureLevel::none);
  const auto volume = [&](const std::string& muscle, int frame) {
    const TriangleMesh surface = recorded_surface(run, muscle, frame);
    return enclosed_volume(surface.vertices, surface.faces);
  };
  std::vector<std::vector<std::string>> findings(run.muscles.size());
  parallel_for_each(run.muscles.size(), [&](std::size_t m) {
    const std::string& muscle = run.muscles[m];
    try {
      const Real rest = volume(muscle, 0);
      for (int frame = 0; frame < run.frame_count; ++frame) {
        const Real told = measured(frame, static_cast<Index>(m));
        if (is_unmeasured && std::isnan(told)) continue;
        const Real ratio = volume(muscle, frame) / rest;
        if (!(std::abs(ratio - told) <= ratio_tolerance))
          findings[m].push_back(
              fmt::format("{} in frame {}: measures.csv says {:.6f} of the volume at rest, the surface has {:.6f}",
                          muscle, frame, told, ratio));
      }
    } catch (const InputError& error) {
      findings[m].push_back(error.what());
    }
  });
  for (const std::vector<std::string>& some : findings)
    result.findings.insert(result.findings.end(), some.begin(), some.end());
}

/// Rows against frames, and the fibers of the last frame against their row.
static void compare_fibers(const RecordedRun& run, Verification& result) {
  const fs::path path = run.folder / "fiber_lengths.sto";
  if (!is_there(path)) return;
  const Table table = read_table(path);
  if (static_cast<int>(table.times.size()) != run.frame_count) {
    result.findings.push_back(
        fmt::format("fiber_lengths.sto has {} rows for {} frames", table.times.size(), run.frame_count));
    return;
  }
  for (const std::string& muscle : run.muscles) {
    if (!column_of(table, muscle)) continue;
    for (int frame = 0; frame < run.frame_count; ++frame) {
      const std::vector<Real> lengths = polyline_lengths(recorded_fibers(run, muscle, frame));
      for (std::size_t f = 0; f < lengths.size(); ++f) {
        const std::optional<Eigen::Index> column = column_of(table, fmt::format("{}_f{:03}", muscle, f));
        const Real told = column ? table.values(frame, *column) : std::nan("");
        if (std::abs(lengths[f] - told) <= length_tolerance) continue;
        result.findings.push_back(
            fmt::format("{} in frame {}: fiber {} is {:.9g} m long, fiber_lengths.sto says {:.9g}", muscle, frame, f,
                        lengths[f], told));
        break;
      }
    }
  }
}

Verification verify_run(const fs::path& folder) {
  const RecordedRun run = open_recorded_run(folder);
  Verification result;
  result.status = run.manifest.value("status", "unknown");
  result.frames = run.frame_count;
  const Real frames = run.manifest.value("frames", Real(-1));
  if (result.status != "running" && frames != run.frame_count)
    result.findings.push_back(fmt::format("run.json tells of {} frames, {} are whole", frames, run.frame_count));
  compare_hashes(run, result);
  const std::size_t before = result.findings.size();
  // Surfaces that have changed need not be measured to be found wrong, but those that have not must agree.
  compare_volumes(run, result);
  if (result.findings.size() == before) compare_fibers(run, result);
  return result;
}

}  // namespace gracilis
