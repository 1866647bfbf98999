#include <gracilis/io/run/recorded_corrections.hpp>

#include <gracilis/dynamics/solver/constraint_table.hpp>
#include <gracilis/io/mesh/mesh_reader_vtp.hpp>
#include <gracilis/io/run/run_folder.hpp>

namespace gracilis {

bool has_corrections(const RecordedRun& run) { return run.manifest.value("corrections", false); }

Corrections recorded_corrections(const RecordedRun& run, const std::string& muscle, int frame) {
  Corrections corrections;
  if (!has_corrections(run)) return corrections;
  const std::shared_ptr<const VtpFile> file = file_of_muscle(run, muscle, frame);
  for (const ConstraintRow& row : constraint_table()) {
    Points moved = file->vectors(correction_name(row.name), piece_of_muscle(run.layout, muscle));
    if (moved.cols() == 0) continue;
    require_count(run, muscle, frame, moved.cols());
    require_finite(moved, file->path(), "a correction");
    corrections[row.name] = std::move(moved);
  }
  return corrections;
}

}  // namespace gracilis
