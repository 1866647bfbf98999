#pragma once

#include <gracilis/io/run/recorded_run.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// A run of one of the methods that are compared, as it lies on disk.
struct ComparedRun {
  std::string method;   ///< its name, or that of the preset
  std::string meaning;  ///< how it deforms muscles
  std::string trouble;  ///< why it ended early; empty: it did not
  RecordedRun run;
};

/// What is told of a muscle's whole run.
struct ComparisonColumn {
  std::string_view key;    ///< in the table of numbers; ends with the unit
  std::string_view title;  ///< in the page, with the unit
  int digits = 0;          ///< after the point
  bool least_is_best = false;
};
/// In the order of the page.
const std::vector<ComparisonColumn>& comparison_columns();

/// One muscle by one method.
struct ComparisonRow {
  std::string method, muscle;
  std::vector<Real> values;  ///< in the order of the columns; nan where the run does not tell
};

/// Rows by method, then muscle. `frames` are those in which surfaces are looked at for cuts in themselves; of other
/// runs than the first the frames in the most similar pose. Throws InputError when a run is damaged.
std::vector<ComparisonRow> comparison_rows(const std::vector<ComparedRun>& runs, const std::vector<int>& frames);

/// The rows as comma separated values, a header first.
std::string comparison_csv(const std::vector<ComparisonRow>& rows);

/// How many pairs of a closed surface's triangles cut each other that did not at `rest`.
Index new_self_intersections(const TriangleMesh& rest, const Points& now);

/// A muscle's fibers over a run's frames up to the farthest pose.
struct FiberCourse {
  std::vector<Real> coordinate;  ///< the main one, in the run's own unit, monotone
  std::vector<Real> length;      ///< m, mean of the fibers
  std::vector<Real> moment_arm;  ///< m, about the main coordinate
};

/// Empty where the run has no fibers of the muscle, or nothing moves.
FiberCourse fiber_course(const RecordedRun& run, const std::string& muscle);

}  // namespace gracilis
