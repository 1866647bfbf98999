#pragma once

#include <gracilis/study/run_measures.hpp>
#include <gracilis/study/study.hpp>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace gracilis {

/// One number per run: a statistic of a metric. nan where a run has none.
struct OutcomeValues {
  StudyOutcome outcome;
  std::string unit;
  std::vector<Real> values;  ///< in the study's order
};

/// Gathers outcomes run by run, in the study's order: those that the study names or, where it names none, of every
/// metric the largest over muscles and frames.
class OutcomeTable {
 public:
  /// `study` must outlive it.
  explicit OutcomeTable(const Study& study);

  /// The next run; null: it has not been measured.
  void add(const RunMeasures* run);
  /// Those that differ between runs, or that the study names. Throws ConfigurationError where it names a metric or
  /// muscle that no run has.
  std::vector<OutcomeValues> finish() const;

 private:
  const Study& study_;
  std::vector<OutcomeValues> outcomes_;
  std::map<std::string, std::string> units_;  ///< of all metrics seen
  std::set<std::string> muscles_;
  std::size_t runs_ = 0;
};

/// "largest vertex_depth of psoas_r".
std::string title_of(const StudyOutcome& outcome);

}  // namespace gracilis
