#include <gracilis/calibrate/evaluator.hpp>

#include <gracilis/core/stop.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/content_hash.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/study/child_process.hpp>

#include <sstream>

namespace gracilis {

namespace fs = std::filesystem;

Evaluator::Evaluator(const std::vector<CalibrationTarget>& targets, const std::vector<CalibrationParameter>& parameters,
                     ObserveFunction observe, EvaluatorOptions options)
    : targets_(targets), parameters_(parameters), observe_(std::move(observe)), options_(std::move(options)) {
  create_folder(options_.folder);
}

static std::string joined(const std::vector<std::string>& values) {
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? "" : ",") + value;
  return text;
}

fs::path Evaluator::file_of(const std::vector<std::string>& values) const {
  return options_.folder / (content_hash_of(joined(values)).substr(0, 16) + ".txt");
}

/// Values, then "seen" and a line per part, or "failed" and why.
void Evaluator::store(const Evaluation& evaluation) const {
  std::string text = joined(evaluation.values) + "\n";
  if (evaluation.observed) {
    text += "seen\n";
    for (const std::vector<std::vector<Real>>& target : *evaluation.observed)
      for (const std::vector<Real>& part : target) {
        for (const Real value : part) text += to_text(value) + " ";
        text += "\n";
      }
    text += "end\n";
  } else {
    text += "failed\n" + evaluation.reason + "\n";
  }
  write_text_atomically(file_of(evaluation.values), text);
}

std::optional<Evaluation> Evaluator::stored(const std::vector<std::string>& values) const {
  const fs::path file = file_of(values);
  if (!is_there(file)) return std::nullopt;
  std::istringstream lines(read_text(file));
  std::string line;
  if (!std::getline(lines, line) || line != joined(values) || !std::getline(lines, line)) return std::nullopt;
  Evaluation evaluation;
  evaluation.values = values;
  if (line == "failed") {
    for (bool first = true; std::getline(lines, line); first = false) evaluation.reason += (first ? "" : "\n") + line;
    return evaluation;
  }
  Observation& observed = evaluation.observed.emplace();
  for (const CalibrationTarget& target : targets_) {
    observed.emplace_back();
    for (std::size_t p = 0; p < target.parts.size(); ++p) {
      if (!std::getline(lines, line)) return std::nullopt;
      std::vector<Real>& part = observed.back().emplace_back();
      for (const std::string_view word : words_of(line))
        if (double value = 0; parse_number(word, value)) part.push_back(value);
    }
  }
  if (!std::getline(lines, line) || line != "end") return std::nullopt;
  return evaluation;
}

/// A failure that comes back however often it is tried.
static bool is_final(int code) {
  return code == static_cast<int>(ExitCode::usage) || code == static_cast<int>(ExitCode::quality);
}

void Evaluator::look(const std::vector<std::size_t>& numbers) {
  std::vector<std::function<int()>> works;
  for (const std::size_t number : numbers)
    works.push_back([this, number] {
      Evaluation& evaluation = all_[number];
      std::vector<std::string> set;
      for (std::size_t p = 0; p < parameters_.size(); ++p)
        set.push_back(parameters_[p].setting.key + "=" + evaluation.values[p]);
      evaluation.observed = observe_(set, targets_);
      store(evaluation);
      return 0;
    });
  ChildOptions child;
  child.log = options_.log;
  child.is_asked_to_stop = options_.is_asked_to_stop;
  std::optional<Error> at_fault;
  bool was_stopped = false;
  const auto settle = [&](std::size_t which, const ChildOutcome& outcome) {
    Evaluation& evaluation = all_[numbers[which]];
    if (outcome.code == 0) {
      const std::optional<Evaluation> seen = stored(evaluation.values);
      if (!seen) throw_write_error(file_of(evaluation.values), "is not what was written");
      evaluation.observed = seen->observed;
    } else if (outcome.code == static_cast<int>(ExitCode::interrupted) ||
               (options_.is_asked_to_stop && options_.is_asked_to_stop())) {
      was_stopped = true;
      return;
    } else if (outcome.code == static_cast<int>(ExitCode::unreadable_input) ||
               outcome.code == static_cast<int>(ExitCode::unsupported)) {
      at_fault.emplace(static_cast<ExitCode>(outcome.code), outcome.reason);
      return;
    } else {
      evaluation.reason = outcome.reason;
      if (is_final(outcome.code)) store(evaluation);
    }
    if (ended) ended(evaluation);
  };
  const std::vector<ChildOutcome> outcomes = run_in_children(works, options_.at_once, child, settle);
  for (const ChildOutcome& outcome : outcomes) was_stopped |= outcome.code == static_cast<int>(ExitCode::interrupted);
  if (at_fault) throw *at_fault;
  if (was_stopped) throw Interrupted();
}

std::vector<Evaluation> Evaluator::evaluate(const std::vector<Eigen::VectorXd>& places) {
  std::vector<std::size_t> asked, left;
  for (const Eigen::VectorXd& place : places) {
    std::vector<std::string> values;
    for (std::size_t p = 0; p < parameters_.size(); ++p)
      values.push_back(setting_text(parameters_[p], place[static_cast<Index>(p)]));
    const auto [found, is_new] = places_.emplace(values, all_.size());
    asked.push_back(found->second);
    if (!is_new) continue;
    std::optional<Evaluation> seen = stored(values);
    known_ += seen.has_value();
    if (!seen) left.push_back(all_.size());
    Evaluation& evaluation = all_.emplace_back(seen ? std::move(*seen) : Evaluation{});
    evaluation.number = static_cast<Index>(all_.size());
    evaluation.values = std::move(values);
  }
  if (!left.empty()) look(left);
  std::vector<Evaluation> result;
  for (const std::size_t number : asked) result.push_back(all_[number]);
  return result;
}

}  // namespace gracilis
