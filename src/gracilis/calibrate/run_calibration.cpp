#include <gracilis/calibrate/run_calibration.hpp>

#include <gracilis/calibrate/direct_search.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/text_cells.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace gracilis {

namespace fs = std::filesystem;

namespace {

/// Every definition of a calibration has this line.
constexpr std::string_view definition_mark = "aimed at\n";

/// A target of which nothing was seen.
std::vector<std::vector<Real>> not_seen(const CalibrationTarget& target) {
  std::vector<std::vector<Real>> parts;
  for (const TargetPart& part : target.parts) parts.emplace_back(part.shape ? 1 : part.values.size(), std::nan(""));
  return parts;
}

/// Of evaluations at the start and at the best point; empty where both are known.
std::string why_not_seen(const Evaluation& start, const Evaluation& best) {
  if (!start.observed) return "cannot be evaluated at the start: " + start.reason;
  return best.observed ? "" : "cannot be evaluated at the best point: " + best.reason;
}

class CalibrationRun {
 public:
  CalibrationRun(Calibration calibration, const SceneMatch& match, const ObserveFunction& observe,
                 const CalibrationOptions& options)
      : options_(options), calibration_(std::move(calibration)) {
    drop_absent(calibration_, match.absent);
    for (std::size_t p = 0; p < match.whole.size(); ++p) calibration_.parameters[p].setting.whole = match.whole[p] != 0;
    aimed_ = targets_that(calibration_, false);
    held_out_ = targets_that(calibration_, true);
    take_folder(match);
    evaluator_.emplace(aimed_, calibration_.parameters, observe, evaluator_options("evaluations"));
    judge_.emplace(held_out_, calibration_.parameters, observe, evaluator_options("held_out"));
    evaluator_->ended = [this](const Evaluation& evaluation) { tell(evaluation); };
    result_.start.resize(static_cast<Index>(calibration_.parameters.size()));
    for (std::size_t p = 0; p < calibration_.parameters.size(); ++p)
      result_.start[static_cast<Index>(p)] = place_of_value(calibration_.parameters[p], match.starts[p]);
  }

  CalibrationResult go() {
    const ResidualFunction ask = [this](const std::vector<Eigen::VectorXd>& points) { return residuals_at(points); };
    const std::vector<Evaluation> first = evaluator_->evaluate({result_.start});
    if (!first[0].observed) throw QualityError("the scene cannot be evaluated at the start: " + first[0].reason);
    if (!residuals(aimed_, *first[0].observed).allFinite())
      throw QualityError("what the scene has at the start is not finite");
    search(ask);
    const Eigen::VectorXd at = *residuals_at({result_.best}).front();
    result_.uncertainty =
        uncertainty_at(result_.best, at, central_slopes(ask, result_.best, at, calibration_.search.difference));
    result_.start_objective = residuals(aimed_, *first[0].observed).squaredNorm();
    result_.objective = at.squaredNorm();
    take_before_and_after();
    result_.evaluations = static_cast<Index>(evaluator_->all().size());
    result_.known = evaluator_->known();
    result_.history = history();
    write_history();
    result_.calibration = calibration_;
    return std::move(result_);
  }

 private:
  EvaluatorOptions evaluator_options(const char* name) const {
    return {options_.folder / name, options_.folder / "log.txt", options_.at_once, options_.is_asked_to_stop};
  }

  /// What was seen under another definition is of no use; it is not taken away unless asked for.
  void take_folder(const SceneMatch& match) {
    create_folder(options_.folder);
    std::string definition = options_.definition + match.inputs;
    for (const CalibrationParameter& each : calibration_.parameters)
      definition += "parameter " + each.setting.key + "\n";
    definition += std::string(definition_mark) + observation_definition(aimed_) + "held out\n" +
                  observation_definition(held_out_);
    const fs::path file = options_.folder / "definition.txt";
    const std::string kept = text_if_there(file);
    if (is_there(file) && kept != definition) {
      if (kept.find(definition_mark) == std::string::npos)
        throw ConfigurationError({file.string(), "", "is not of a calibration", "take another folder by --out"});
      if (!options_.force)
        throw ConfigurationError({options_.folder.string(), "",
                                  "holds a calibration of another scene, other targets, parameters or settings",
                                  "take another folder by --out, or --force to begin anew"});
      for (const char* part : {"evaluations", "held_out", "evaluations.csv", "log.txt"})
        fs::remove_all(options_.folder / part);
    }
    if (kept != definition) write_text_atomically(file, definition);
  }

  std::vector<std::optional<Eigen::VectorXd>> residuals_at(const std::vector<Eigen::VectorXd>& points) {
    std::vector<std::optional<Eigen::VectorXd>> result;
    for (const Evaluation& evaluation : evaluator_->evaluate(points)) {
      result.emplace_back();
      if (!evaluation.observed) continue;
      Eigen::VectorXd at = residuals(aimed_, *evaluation.observed);
      if (at.allFinite()) result.back() = std::move(at);
    }
    return result;
  }

  void search(const ResidualFunction& ask) {
    const CalibrationSearch& how = calibration_.search;
    Eigen::VectorXd begin = result_.start;
    if (how.samples > 0) begin = best_sample(ask);
    const LeastSquaresOptions options{how.difference, how.stop, how.evaluations};
    const SearchEnd end = how.method == SearchMethod::least_squares ? least_squares(ask, begin, options)
                                                                    : direct_search(how.method, ask, begin, options);
    result_.best = end.best;
    result_.stopped = end.stopped;
  }

  /// The best of the start and points that are spread over the bounds.
  Eigen::VectorXd best_sample(const ResidualFunction& ask) const {
    const CalibrationSearch& how = calibration_.search;
    Sampling sampling;
    sampling.kind = how.sampling;
    sampling.samples = how.samples;
    sampling.seeds = {how.seed};
    const Index columns = result_.start.size();
    const Eigen::MatrixXd points = design_points(sampling, columns, {}, {});
    std::vector<Eigen::VectorXd> places = {result_.start};
    for (Index row = 0; row < points.rows(); ++row) places.emplace_back(points.row(row).transpose());
    const auto seen = ask(places);
    std::size_t best = seen.size();
    for (std::size_t i = 0; i < seen.size(); ++i)
      if (seen[i] && (best == seen.size() || seen[i]->squaredNorm() < seen[best]->squaredNorm())) best = i;
    if (best == seen.size()) throw QualityError("the scene can be evaluated at none of the samples");
    return places[best];
  }

  void take_before_and_after() {
    const std::vector<Eigen::VectorXd> ends = {result_.start, result_.best};
    const std::vector<Evaluation> aimed = evaluator_->evaluate(ends);
    std::vector<Evaluation> judged;
    if (!held_out_.empty()) judged = judge_->evaluate(ends);
    std::size_t next_aimed = 0, next_judged = 0;
    for (const CalibrationTarget& target : calibration_.targets) {
      const std::vector<Evaluation>& from = target.held_out ? judged : aimed;
      const std::size_t at = target.held_out ? next_judged++ : next_aimed++;
      for (const auto& [evaluation, to] : {std::pair{&from[0], &result_.before}, {&from[1], &result_.after}})
        to->push_back(evaluation->observed ? (*evaluation->observed)[at] : not_seen(target));
      const std::string& remark = result_.remarks.emplace_back(why_not_seen(from[0], from[1]));
      if (!remark.empty() && options_.say) options_.say(target.name + " is left blank, for it " + remark);
    }
    result_.start_values = aimed[0].values;
    result_.best_values = aimed[1].values;
  }

  HistoryRow row_of(const Evaluation& evaluation) const {
    HistoryRow row{evaluation.values, std::nan(""), {}, evaluation.reason};
    if (!evaluation.observed) return row;
    row.objective = residuals(aimed_, *evaluation.observed).squaredNorm();
    for (std::size_t t = 0; t < aimed_.size(); ++t) row.rms.push_back(target_rms(aimed_[t], (*evaluation.observed)[t]));
    return row;
  }

  bool is_known(const Evaluation& evaluation) const { return evaluation.observed || !evaluation.reason.empty(); }

  std::vector<HistoryRow> history() const {
    std::vector<HistoryRow> rows;
    for (const Evaluation& evaluation : evaluator_->all()) rows.push_back(row_of(evaluation));
    return rows;
  }

  /// All of it each time: it is small, and so it is whole and in order whenever the process ends.
  void write_history() const {
    std::string text = "evaluation";
    for (const CalibrationParameter& each : calibration_.parameters) text += "," + csv_cell(each.setting.key);
    text += ",objective";
    for (const CalibrationTarget& target : aimed_)
      text += "," + csv_cell(target.name + " rms_" + shown_unit(target.kind));
    text += ",reason\n";
    for (const Evaluation& evaluation : evaluator_->all()) {
      if (!is_known(evaluation)) continue;
      const HistoryRow row = row_of(evaluation);
      text += fmt::format("{}", evaluation.number);
      for (const std::string& value : row.values) text += "," + value;
      text += std::isnan(row.objective) ? "," : fmt::format(",{}", row.objective);
      for (std::size_t t = 0; t < aimed_.size(); ++t)
        text += t < row.rms.size() ? fmt::format(",{:.6g}", shown_factor(aimed_[t].kind) * row.rms[t]) : ",";
      text += "," + csv_cell(row.reason) + "\n";
    }
    write_text_atomically(options_.folder / "evaluations.csv", text);
  }

  void tell(const Evaluation& evaluation) {
    write_history();
    if (!options_.say) return;
    std::string text;
    for (std::size_t p = 0; p < evaluation.values.size(); ++p)
      text += fmt::format("{}{} = {:.6g}", p > 0 ? ", " : "", calibration_.parameters[p].setting.key,
                          std::stod(evaluation.values[p]));
    const Real objective = row_of(evaluation).objective;
    options_.say(fmt::format("evaluation {}: {}: {}", evaluation.number,
                             std::isnan(objective) ? "failed" : fmt::format("objective {:.5g}", objective), text) +
                 (evaluation.reason.empty() ? "" : ": " + evaluation.reason));
  }

  const CalibrationOptions& options_;
  Calibration calibration_;
  std::vector<CalibrationTarget> aimed_, held_out_;
  std::optional<Evaluator> evaluator_, judge_;
  CalibrationResult result_;
};

}  // namespace

CalibrationResult run_calibration(Calibration calibration, const SceneMatch& match, const ObserveFunction& observe,
                                  const CalibrationOptions& options) {
  return CalibrationRun(std::move(calibration), match, observe, options).go();
}

}  // namespace gracilis
