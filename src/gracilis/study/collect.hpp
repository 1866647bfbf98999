#pragma once

#include <gracilis/study/run_measures.hpp>
#include <gracilis/study/run_record.hpp>

#include <string>

namespace gracilis {

struct CollectEnd {
  int collected = 0, failed = 0, left = 0;
  double rows = 0;
  std::string remark;  ///< on files that runs read and that are not there; empty: all are
};

/// Writes into the study's folder, each whole or not at all:
///
///   measures.csv   run, muscle, frame, metric, value, unit; a line per number, as the runs wrote it
///   frames.csv     run, frame, coordinate, value, unit; time and pose
///   runs.csv       run, state, scene, a column per parameter, seconds, processor_seconds, peak_memory_mb, reason
///   failures.csv   run, exit_code, reason; also of complete runs whose tables have changed since
///
/// Runs in the study's order; one whose inputs are not there counts as complete, for results may have been copied
/// without them. Throws InputError where they cannot be written.
CollectEnd collect_study(const Study& study, const std::string& version);

}  // namespace gracilis
