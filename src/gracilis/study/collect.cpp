#include <gracilis/study/collect.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/text_cells.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace gracilis {

namespace fs = std::filesystem;

namespace {

class TableFile {
 public:
  TableFile(const fs::path& path, const fs::path& temporary, const std::string& head)
      : path_(path), stream_(temporary, std::ios::binary) {
    stream_ << head << "\n";
  }
  void add(const std::string& lines) { stream_ << lines; }
  void close() {
    stream_.close();
    if (!stream_) throw_write_error(path_, std::string("cannot be written: ") + std::strerror(errno));
  }

 private:
  fs::path path_;
  std::ofstream stream_;
};

std::string rows_of(const std::string& run, const RunMeasures& measures, double& count) {
  std::string text;
  for (const RunMeasures::Row& row : measures.rows)
    for (std::size_t m = 0; m < measures.metrics.size(); ++m) {
      if (row.cells[m].empty()) continue;
      text += fmt::format("{},{},{},{},{},{}\n", run, measures.muscles[row.muscle], row.frame, measures.metrics[m].name,
                          row.cells[m], measures.metrics[m].unit);
      ++count;
    }
  return text;
}

/// Time and pose; each frame once, with its first muscle.
std::string poses_of(const std::string& run, const RunMeasures& measures) {
  std::string text;
  int last = -1;
  for (const RunMeasures::Row& row : measures.rows) {
    if (row.frame == last) continue;
    last = row.frame;
    text += fmt::format("{},{},time,{},s\n", run, row.frame, row.time);
    for (std::size_t c = 0; c < measures.coordinates.size(); ++c) {
      const MetricName name = metric_name(measures.coordinates[c]);
      text += fmt::format("{},{},{},{},{}\n", run, row.frame, name.name, row.pose[c], name.unit);
    }
  }
  return text;
}

std::string run_row(const StudyRun& run, const RunStanding& standing) {
  std::string text = run.name + "," + name_of(standing.state) + "," + csv_cell(run.scene);
  for (const std::string& value : run.values) text += "," + csv_cell(value);
  if (standing.record)
    text += fmt::format(",{:.3f},{:.3f},{:.1f}", standing.record->seconds, standing.record->processor_seconds,
                        1e-6 * standing.record->peak_bytes);
  else
    text += ",,,";
  return text + "," + csv_cell(standing.reason) + "\n";
}

std::string runs_head(const Study& study) {
  std::string head = "run,state,scene";
  // A study over scenes has the scene's column already.
  for (const std::string& key : study.parameters)
    head += "," + (key == "scene" ? std::string("scene_given") : csv_cell(key));
  return head + ",seconds,processor_seconds,peak_memory_mb,reason";
}

}  // namespace

CollectEnd collect_study(const Study& study, const std::string& version) {
  create_folder(study.folder);
  CollectEnd end;
  InputHashes hashes;
  std::string runs = runs_head(study) + "\n", failures = "run,exit_code,reason\n";
  const fs::path measures_file = study.folder / "measures.csv", frames_file = study.folder / "frames.csv";
  write_file_atomically(frames_file, [&](const fs::path& frames_temporary) {
    write_file_atomically(measures_file, [&](const fs::path& temporary) {
      TableFile measures(measures_file, temporary, "run,muscle,frame,metric,value,unit");
      TableFile frames(frames_file, frames_temporary, "run,frame,coordinate,value,unit");
      for (const StudyRun& run : study.runs) {
        RunStanding standing = standing_of(study, run, version, hashes, AbsentInput::is_passed_over);
        if (standing.state == RunState::complete) {
          try {
            const RunMeasures found = read_run_measures(complete_folder(study, run));
            measures.add(rows_of(run.name, found, end.rows));
            frames.add(poses_of(run.name, found));
            ++end.collected;
          } catch (const InputError& error) {
            standing.state = RunState::failed;
            standing.reason = error.what();
            if (standing.record) standing.record->code = static_cast<int>(ExitCode::unreadable_input);
          }
        }
        runs += run_row(run, standing);
        if (has_failed(standing)) {
          failures += fmt::format("{},{},{}\n", run.name, standing.record->code, csv_cell(standing.reason));
          ++end.failed;
        } else if (standing.state != RunState::complete) {
          ++end.left;
        }
      }
      measures.close();
      frames.close();
    });
  });
  write_text_atomically(study.folder / "runs.csv", runs);
  write_text_atomically(study.folder / "failures.csv", failures);
  end.remark = remark_on_absent(hashes);
  return end;
}

}  // namespace gracilis
