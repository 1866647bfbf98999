#pragma once

#include <gracilis/io/run/run_layout.hpp>
#include <gracilis/simulate/gates.hpp>
#include <gracilis/study/design.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// One of a study's runs.
struct StudyRun {
  std::string name;                 ///< of its folder
  std::string scene;                ///< "demo", "demo-elbow" or a scene file, as the study says
  std::optional<Real> flexion_deg;  ///< of a built-in scene
  std::vector<std::string> set;     ///< KEY=VALUE, as `--set` takes them: those of all runs, then its own
  std::vector<std::string> values;  ///< per parameter; empty where the run leaves it as it is
};

/// What is recorded of every run, as `gracilis run` can be told.
struct StudyRecording {
  MeasureLevel measures = MeasureLevel::full;
  bool fibers = true, ramps = true, arms = false, pictures = false;
  int every = 1;
  RunLayout layout = RunLayout::compact;
};

/// Which number of a run the report is about: of a metric, over all frames of one muscle or, where none is named, of
/// all.
struct StudyOutcome {
  enum class Statistic { largest, smallest, mean, last };
  std::string metric, muscle;
  Statistic statistic = Statistic::largest;
};

/// A study, as its file describes it, with all of its runs.
struct Study {
  std::filesystem::path file;     ///< its description
  std::filesystem::path folder;   ///< what it leaves behind
  std::filesystem::path data;     ///< of its scenes' files; empty: where scenes look by themselves
  std::vector<std::string> only;  ///< muscles to keep; empty: all
  StudyRecording recording;
  Real most_seconds = 0;  ///< that a run may take; 0: any
  Sampling sampling;
  std::vector<std::string> parameters;  ///< their keys
  Eigen::MatrixXd points;               ///< runs × parameters, in the unit cube; empty where runs are listed
  std::vector<StudyRun> runs;
  std::vector<StudyOutcome> outcomes;  ///< empty: all metrics
};

/// The scene's file, where it lies: paths in a study are relative to it. Empty for built-in scenes.
std::filesystem::path scene_file(const Study& study, const StudyRun& run);

/// All that decides about a run's results, but for the content of the files that it reads: a line each.
std::string run_definition(const Study& study, const StudyRun& run, const std::string& version);

/// The command line that does the same run alone.
std::string command_alone(const Study& study, const StudyRun& run);

/// "largest", "smallest", "mean", "last".
std::string name_of(StudyOutcome::Statistic statistic);

}  // namespace gracilis
