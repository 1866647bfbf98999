#pragma once

#include <gracilis/io/tables/table.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Samples for joint control units, from motions and the results of static optimization.
namespace gracilis {

/// How the activations of a muscle that the results split into parts become one.
enum class CombineParts {
  sum,            ///< as published; may exceed 1, which is reported
  weighted_mean,  ///< weighted by the parts' forces at that time
  maximum
};

/// The way of that name: "sum", "weighted_mean" or "maximum".
std::optional<CombineParts> find_combination(const std::string& name);

/// A muscle of the scene and the columns that are its parts.
struct MuscleParts {
  std::string muscle;
  std::vector<std::string> columns;
};

struct JoinSettings {
  CombineParts combine = CombineParts::sum;
  Real tolerance = 0.001;            ///< s, farthest that times which belong together may lie apart
  std::vector<MuscleParts> muscles;  ///< empty: every column that is a muscle, numbered parts as one
};

/// A motion with the results that belong to it; `forces` has no rows unless means are weighted.
struct Trial {
  std::string name;
  Table motion, activations, forces;
};

/// Joint angles and activations that belong together, and what was wrong with the files.
struct JoinedSamples {
  Table samples;                      ///< time, coordinates in degrees, muscles
  std::vector<std::string> problems;  ///< one line each: missing columns, times that do not meet, negative values
  std::vector<std::string> notes;     ///< columns left out, sums above 1
};

/// Joins the results of each trial with the motion's rows at the same times, or the nearest within the tolerance; rows
/// without one are left out. Coordinates are those that all motions have. Times of trials after the first are shifted
/// so that they go on increasing. Negative activations count as 0. Throws InputError when nothing is left.
JoinedSamples join_samples(const std::vector<Trial>& trials, const JoinSettings& settings);

/// Whether a column of static optimization's results is a muscle, by its name: residual and reserve actuators (FX ...
/// MZ, names with "reserve", "residual" or "actuator") are not.
bool is_muscle_column(const std::string& name);

/// Numbered parts under one name ("glut_max1_r", "glut_max2_r" → "glut_max_r"), other columns under their own.
std::vector<MuscleParts> grouped_parts(const std::vector<std::string>& columns);

/// Reads a mapping (TOML): muscle = "column" or muscle = ["column", "column"]. Throws ConfigurationError.
std::vector<MuscleParts> read_muscle_mapping(const std::filesystem::path& path);

/// Files of two folders (or two files) that belong together: those with equal names before the extension (.mot, .sto),
/// and `pairs`, whose names differ. Lists what has no partner in `problems`.
std::vector<std::pair<std::filesystem::path, std::filesystem::path>> paired_files(
    const std::filesystem::path& motions, const std::filesystem::path& results,
    const std::vector<std::pair<std::string, std::string>>& pairs, std::vector<std::string>& problems);

}  // namespace gracilis
