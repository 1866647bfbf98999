#include <gracilis/io/tables/activation_samples.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/parse_toml.hpp>

#include <toml++/toml.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace gracilis {

namespace fs = std::filesystem;

std::optional<CombineParts> find_combination(const std::string& name) {
  if (name == "sum") return CombineParts::sum;
  if (name == "weighted_mean") return CombineParts::weighted_mean;
  if (name == "maximum") return CombineParts::maximum;
  return std::nullopt;
}

bool is_muscle_column(const std::string& name) {
  static constexpr std::array residuals = {"FX", "FY", "FZ", "MX", "MY", "MZ"};
  if (std::find(residuals.begin(), residuals.end(), name) != residuals.end()) return false;
  static constexpr std::array actuators = {"reserve", "residual", "actuator"};
  return std::none_of(actuators.begin(), actuators.end(),
                      [&](const char* part) { return name.find(part) != std::string::npos; });
}

/// "glut_max1_r" → "glut_max_r": without the last digits before the side.
static std::string without_number(const std::string& name) {
  std::string side;
  std::string stem = name;
  if (name.ends_with("_r") || name.ends_with("_l")) {
    side = name.substr(name.size() - 2);
    stem.resize(stem.size() - 2);
  }
  while (!stem.empty() && std::isdigit(static_cast<unsigned char>(stem.back()))) stem.pop_back();
  return stem.empty() ? name : stem + side;
}

std::vector<MuscleParts> grouped_parts(const std::vector<std::string>& columns) {
  std::vector<MuscleParts> muscles;
  for (const std::string& column : columns) {
    if (!is_muscle_column(column)) continue;
    const std::string name = without_number(column);
    const auto found =
        std::find_if(muscles.begin(), muscles.end(), [&](const MuscleParts& muscle) { return muscle.muscle == name; });
    if (found == muscles.end()) {
      muscles.push_back({name, {column}});
    } else {
      found->columns.push_back(column);
    }
  }
  // A number that tells nothing apart belongs to the name.
  for (MuscleParts& muscle : muscles)
    if (muscle.columns.size() == 1) muscle.muscle = muscle.columns[0];
  return muscles;
}

std::vector<MuscleParts> read_muscle_mapping(const fs::path& path) {
  const toml::table table =
      parse_written_toml(read_text(path), path.string(), "write: muscle = [\"column\", \"column\"]");
  std::vector<MuscleParts> muscles;
  std::vector<Problem> problems;
  for (const auto& [key, value] : table) {
    MuscleParts muscle{std::string(key.str()), {}};
    if (const auto one = value.value<std::string>()) muscle.columns.push_back(*one);
    if (const toml::array* several = value.as_array())
      for (const toml::node& entry : *several)
        if (const auto name = entry.value<std::string>()) muscle.columns.push_back(*name);
    if (muscle.columns.empty()) {
      problems.push_back({path.string(), std::to_string(value.source().begin.line),
                          fmt::format("'{}' names no columns", muscle.muscle), "write: muscle = [\"column\", ...]"});
    }
    muscles.push_back(std::move(muscle));
  }
  if (muscles.empty()) problems.push_back({path.string(), "", "maps no muscle", "write: muscle = [\"column\", ...]"});
  if (!problems.empty()) throw ConfigurationError(problems);
  return muscles;
}

namespace {

/// The row with the time nearest to `time`.
Eigen::Index nearest_row(const std::vector<Real>& times, Real time) {
  const auto above = std::lower_bound(times.begin(), times.end(), time);
  if (above == times.begin()) return 0;
  if (above == times.end()) return static_cast<Eigen::Index>(times.size()) - 1;
  const auto i = above - times.begin();
  return time - *(above - 1) <= *above - time ? i - 1 : i;
}

/// Joins one trial after the other.
class Joiner {
 public:
  Joiner(const std::vector<Trial>& trials, const JoinSettings& settings) : trials_(trials), settings_(settings) {}

  JoinedSamples join() {
    choose_columns();
    for (const Trial& trial : trials_) add(trial);
    for (const auto& [muscle, excess] : excesses_) {
      joined_.notes.push_back(fmt::format("{}: the sum of its parts exceeds 1 in {} of {} samples, up to {:.3f}",
                                          muscle, excess.first, rows_.size(), excess.second));
    }
    if (rows_.empty() || muscles_.empty() || coordinates_.empty()) {
      std::string why = "no sample is left";
      for (const std::string& problem : joined_.problems) why += "; " + problem;
      throw InputError(
          {trials_.empty() ? "" : trials_[0].name, "", why, "check that motions and results belong together"});
    }
    Table& samples = joined_.samples;
    samples.name = "activation_samples";
    samples.in_degrees = true;
    samples.columns = coordinates_;
    for (const MuscleParts& muscle : muscles_) samples.columns.push_back(muscle.muscle);
    samples.times = times_;
    samples.values.resize(static_cast<Index>(rows_.size()), static_cast<Index>(samples.columns.size()));
    for (std::size_t row = 0; row < rows_.size(); ++row) samples.values.row(static_cast<Index>(row)) = rows_[row];
    return std::move(joined_);
  }

 private:
  void problem(const Trial& trial, const std::string& what) { joined_.problems.push_back(trial.name + ": " + what); }

  void choose_columns() {
    muscles_ = settings_.muscles;
    std::set<std::string> left_out;
    if (muscles_.empty() && !trials_.empty()) {
      muscles_ = grouped_parts(trials_[0].activations.columns);
      for (const Trial& trial : trials_)
        for (const std::string& column : trial.activations.columns)
          if (!is_muscle_column(column)) left_out.insert(column);
    }
    if (!left_out.empty()) joined_.notes.push_back(fmt::format("no muscles, left out: {}", fmt::join(left_out, ", ")));
    for (std::size_t t = 0; t < trials_.size(); ++t) {
      const std::vector<std::string> here = motion_from_table(trials_[t].motion).coordinates;
      if (t == 0) coordinates_ = here;
      std::erase_if(coordinates_, [&](const std::string& name) {
        const bool missing = std::find(here.begin(), here.end(), name) == here.end();
        if (missing) problem(trials_[t], fmt::format("the motion has no column '{}'; it is left out", name));
        return missing;
      });
    }
    // A muscle none of whose parts is anywhere cannot be sampled.
    std::erase_if(muscles_, [&](const MuscleParts& muscle) {
      const bool found = std::any_of(trials_.begin(), trials_.end(), [&](const Trial& trial) {
        return std::any_of(muscle.columns.begin(), muscle.columns.end(),
                           [&](const std::string& name) { return column_of(trial.activations, name).has_value(); });
      });
      if (!found)
        joined_.problems.push_back(fmt::format("{}: none of its columns ({}) is in the results; it is left out",
                                               muscle.muscle, fmt::join(muscle.columns, ", ")));
      return !found;
    });
  }

  /// The parts that the trial has; says which are missing.
  std::vector<std::string> parts_in(const Trial& trial, const MuscleParts& muscle) {
    std::vector<std::string> parts;
    for (const std::string& name : muscle.columns) {
      if (column_of(trial.activations, name)) {
        parts.push_back(name);
      } else {
        problem(trial, fmt::format("the results have no column '{}' of {}", name, muscle.muscle));
      }
      if (settings_.combine == CombineParts::weighted_mean && !column_of(trial.forces, name))
        problem(trial, fmt::format("the forces have no column '{}' of {}; it weighs nothing", name, muscle.muscle));
    }
    return parts;
  }

  Real combined(const Trial& trial, const std::vector<std::string>& parts, Eigen::Index row) const {
    Real sum = 0, weights = 0, weighted = 0, largest = 0;
    for (const std::string& name : parts) {
      const Real value = std::max(trial.activations.values(row, *column_of(trial.activations, name)), Real{0});
      sum += value;
      largest = std::max(largest, value);
      const std::optional<Eigen::Index> force = column_of(trial.forces, name);
      if (!force) continue;
      const Eigen::Index at = nearest_row(trial.forces.times, trial.activations.times[static_cast<std::size_t>(row)]);
      const Real weight = std::max(trial.forces.values(at, *force), Real{0});
      weights += weight;
      weighted += weight * value;
    }
    if (settings_.combine == CombineParts::maximum) return largest;
    if (settings_.combine == CombineParts::sum) return sum;
    return weights > 0 ? weighted / weights : parts.empty() ? 0 : sum / static_cast<Real>(parts.size());
  }

  void count_negatives(const Trial& trial, const std::vector<std::string>& parts) {
    for (const std::string& name : parts) {
      const auto values = trial.activations.values.col(*column_of(trial.activations, name));
      const Eigen::Index negative = (values.array() < 0).count();
      if (negative > 0)
        problem(trial, fmt::format("'{}' is negative in {} of {} rows, down to {:.4g}; taken as 0", name, negative,
                                   values.size(), values.minCoeff()));
    }
  }

  void add(const Trial& trial) {
    const Motion motion = motion_from_table(trial.motion);
    std::vector<std::vector<std::string>> parts;
    for (const MuscleParts& muscle : muscles_) {
      parts.push_back(parts_in(trial, muscle));
      count_negatives(trial, parts.back());
    }
    const Real shift = times_.empty() ? 0 : std::max(times_.back() + 1 - trial.activations.times.front(), Real{0});
    std::size_t unmatched = 0;
    Real first_unmatched = 0;
    for (std::size_t row = 0; row < trial.activations.times.size(); ++row) {
      const Real time = trial.activations.times[row];
      const Eigen::Index at = nearest_row(trial.motion.times, time);
      if (std::abs(trial.motion.times[static_cast<std::size_t>(at)] - time) > settings_.tolerance + 1e-12) {
        if (unmatched++ == 0) first_unmatched = time;
        continue;
      }
      Eigen::RowVectorXd sample(static_cast<Index>(coordinates_.size() + muscles_.size()));
      for (std::size_t c = 0; c < coordinates_.size(); ++c) {
        const auto column = std::find(motion.coordinates.begin(), motion.coordinates.end(), coordinates_[c]);
        sample[static_cast<Index>(c)] = degrees(motion.values(at, column - motion.coordinates.begin()));
      }
      for (std::size_t m = 0; m < muscles_.size(); ++m) {
        const Real value = combined(trial, parts[m], static_cast<Eigen::Index>(row));
        sample[static_cast<Index>(coordinates_.size() + m)] = value;
        if (value <= 1) continue;
        auto& [count, largest] = excesses_[muscles_[m].muscle];
        ++count;
        largest = std::max(largest, value);
      }
      times_.push_back(time + shift);
      rows_.push_back(std::move(sample));
    }
    if (unmatched > 0)
      problem(trial,
              fmt::format("{} of {} times of the results have no row of the motion within {} s, first {} s; left "
                          "out",
                          unmatched, trial.activations.times.size(), settings_.tolerance, first_unmatched));
  }

  const std::vector<Trial>& trials_;
  const JoinSettings& settings_;
  JoinedSamples joined_;
  std::vector<MuscleParts> muscles_;
  std::vector<std::string> coordinates_;
  std::vector<Real> times_;
  std::vector<Eigen::RowVectorXd> rows_;
  std::map<std::string, std::pair<int, Real>> excesses_;  ///< samples above 1 and the largest
};

std::map<std::string, fs::path> tables_in(const fs::path& folder) {
  std::map<std::string, fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string extension = lower_case_extension(entry.path());
    if (extension == ".mot" || extension == ".sto") files[entry.path().stem().string()] = entry.path();
  }
  return files;
}

}  // namespace

JoinedSamples join_samples(const std::vector<Trial>& trials, const JoinSettings& settings) {
  return Joiner(trials, settings).join();
}

std::vector<std::pair<fs::path, fs::path>> paired_files(const fs::path& motions, const fs::path& results,
                                                        const std::vector<std::pair<std::string, std::string>>& pairs,
                                                        std::vector<std::string>& problems) {
  for (const fs::path& path : {motions, results})
    if (!fs::exists(path)) throw InputError({path.string(), "", "does not exist", ""});
  std::vector<std::pair<fs::path, fs::path>> files;
  if (fs::is_regular_file(motions) && fs::is_regular_file(results)) return {{motions, results}};
  for (const fs::path& path : {motions, results})
    if (!fs::is_directory(path)) throw InputError({path.string(), "", "is no folder", "give two folders or two files"});
  for (const auto& [motion, result] : pairs) files.emplace_back(motions / motion, results / result);
  if (!pairs.empty() && fs::equivalent(motions, results)) return files;  // all of one folder would pair with itself
  const std::map<std::string, fs::path> motion_files = tables_in(motions), result_files = tables_in(results);
  const auto in_pairs = [&](const fs::path& path) {
    return std::any_of(files.begin(), files.end(),
                       [&](const auto& pair) { return pair.first == path || pair.second == path; });
  };
  for (const auto& [name, path] : motion_files) {
    if (in_pairs(path)) continue;
    const auto result = result_files.find(name);
    if (result != result_files.end()) {
      files.emplace_back(path, result->second);
    } else {
      problems.push_back(path.string() + ": there are no results of that name; use --pair where names differ");
    }
  }
  for (const auto& [name, path] : result_files)
    if (!in_pairs(path) && !motion_files.contains(name))
      problems.push_back(path.string() + ": there is no motion of that name; use --pair where names differ");
  return files;
}

}  // namespace gracilis
