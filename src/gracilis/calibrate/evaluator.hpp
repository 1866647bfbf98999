#pragma once

#include <gracilis/calibrate/observation.hpp>

#include <functional>
#include <map>

namespace gracilis {

/// What a scene has with these settings (KEY=VALUE). Called in a process of its own; may throw.
using ObserveFunction =
    std::function<Observation(const std::vector<std::string>& set, const std::vector<CalibrationTarget>& targets)>;

/// Parameters at which a scene was looked at, and what was seen.
struct Evaluation {
  Index number = 0;  ///< in the order in which they were asked for, from 1
  std::vector<std::string> values;
  std::optional<Observation> observed;  ///< none: it failed
  std::string reason;                   ///< why
};

struct EvaluatorOptions {
  std::filesystem::path folder;  ///< of what was seen, a file per evaluation
  std::filesystem::path log;     ///< what processes say
  int at_once = 1;               ///< processes
  std::function<bool()> is_asked_to_stop = {};
};

/// Looks at scenes with other parameters, some at a time, each in a process of its own. What was seen is on the disk
/// before it is told, whole or not at all, so that nothing is looked at twice: not within a process that was killed and
/// started again, either.
class Evaluator {
 public:
  /// `targets` and `parameters` must outlive this. Throws InputError where the folder cannot be written.
  Evaluator(const std::vector<CalibrationTarget>& targets, const std::vector<CalibrationParameter>& parameters,
            ObserveFunction observe, EvaluatorOptions options);

  /// Called for each point that was looked at, not for those known, once it is on the disk.
  std::function<void(const Evaluation&)> ended;

  /// Evaluations at places in the unit cube, in their order; the same text is looked at once. A failed one that could
  /// come out otherwise (a crash) is tried again by the next process. Throws Interrupted when asked to stop, Error
  /// where files of the scene are at fault.
  std::vector<Evaluation> evaluate(const std::vector<Eigen::VectorXd>& places);

  /// All so far, in the order in which they were asked for.
  const std::vector<Evaluation>& all() const { return all_; }
  Index known() const { return known_; }  ///< of these, by what an earlier process saw

 private:
  std::filesystem::path file_of(const std::vector<std::string>& values) const;
  std::optional<Evaluation> stored(const std::vector<std::string>& values) const;
  void store(const Evaluation& evaluation) const;
  void look(const std::vector<std::size_t>& numbers);

  const std::vector<CalibrationTarget>& targets_;
  const std::vector<CalibrationParameter>& parameters_;
  ObserveFunction observe_;
  EvaluatorOptions options_;
  std::vector<Evaluation> all_;
  std::map<std::vector<std::string>, std::size_t> places_;  ///< in all_
  Index known_ = 0;
};

}  // namespace gracilis
