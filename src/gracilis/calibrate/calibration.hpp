#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/study/study_parameter.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// What a scene's muscles are compared with.
enum class TargetKind { moment_arms, lengths, volumes, shapes };
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 4> choices_of(TargetKind) {
  return {"moment_arms", "lengths", "volumes", "shapes"};
}

/// Whether its values stand over a coordinate.
inline bool is_curve(TargetKind kind) { return kind == TargetKind::moment_arms || kind == TargetKind::lengths; }

/// What a target tells of one muscle.
struct TargetPart {
  std::string muscle, source;
  std::vector<Real> at = {};                       ///< of curves: rad, ascending
  std::vector<Real> values = {};                   ///< per `at`, m; of volumes one, m³; of shapes none
  std::shared_ptr<const TriangleMesh> shape = {};  ///< m
};

/// One thing to aim at, of one or more muscles.
struct CalibrationTarget {
  std::string name;
  TargetKind kind = TargetKind::moment_arms;
  std::string coordinate;            ///< of curves
  std::map<std::string, Real> pose;  ///< of other coordinates, degrees (mm of translations)
  Real weight = 1;
  Real tolerance = 0.001;      ///< m, of volumes m³: a difference that counts as 1
  bool change = false;         ///< of lengths: their means over the angles are left out of the comparison
  bool held_out = false;       ///< looked at before and after, but not aimed at
  bool names_muscles = false;  ///< its parts are for muscles that the file names; others may be missing in the scene
  std::vector<TargetPart> parts;
  Problem place;
};

/// A setting that is looked for.
struct CalibrationParameter {
  StudyParameter setting;     ///< its key and bounds
  std::optional<Real> start;  ///< none: what the scene has
  Problem place;
};

/// How values are looked for.
enum class SearchMethod { least_squares, bobyqa, cobyla, sbplx };
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 4> choices_of(SearchMethod) {
  return {"least-squares", "bobyqa", "cobyla", "sbplx"};
}

struct CalibrationSearch {
  SearchMethod method = SearchMethod::least_squares;
  Index samples = 0;  ///< points spread over the bounds, of which the best is where the search begins; 0: the start
  SamplingKind sampling = SamplingKind::sobol;
  std::uint64_t seed = 1;   ///< of latin
  Index evaluations = 200;  ///< at most, of the search
  Real difference = 0.02;   ///< of least squares: the step for differences, as a share of the bounds
  Real stop = 1e-4;         ///< relative change of the objective, and share of the bounds, below which it ends
};

/// A calibration, as its file describes it.
struct Calibration {
  std::filesystem::path file;
  std::vector<CalibrationTarget> targets;
  std::vector<CalibrationParameter> parameters;
  CalibrationSearch search;
  std::vector<std::filesystem::path> inputs;  ///< files that were read, this one first
};

/// "--set" text of a value at a place of the unit interval between a parameter's bounds.
std::string setting_text(const CalibrationParameter& parameter, Real place);
/// The number that this is.
Real setting_value(const CalibrationParameter& parameter, Real place);
/// The place of a value; clamped to the bounds.
Real place_of_value(const CalibrationParameter& parameter, Real value);

/// "moment arms", "lengths" ... for people.
std::string words_of(TargetKind kind);
/// What its values are shown in, and how many of these are 1 m (m³).
std::string shown_unit(TargetKind kind);
/// How many of shown_unit are 1 m (m³).
Real shown_factor(TargetKind kind);

/// The targets that are aimed at, or those that are held out.
std::vector<CalibrationTarget> targets_that(const Calibration& calibration, bool held_out);

/// What a scene has where targets have values: per target and part. Of curves m, of volumes m³, of shapes the distances
/// of some of the muscle's vertices from the target's surface, m, negative inside of it.
using Observation = std::vector<std::vector<std::vector<Real>>>;

/// What a scene has less what targets say, over their tolerances, such that the sum of squares is the objective: over
/// all targets, weight × mean square of their values. Every value of every part in order. A target whose values lie one
/// tolerance off adds its weight, however many values it has.
Eigen::VectorXd residuals(const std::vector<CalibrationTarget>& targets, const Observation& observed);

/// Differences of one part, m (m³).
std::vector<Real> differences(const CalibrationTarget& target, const TargetPart& part,
                              const std::vector<Real>& observed);

/// Root mean square over a target's values, m (m³).
Real target_rms(const CalibrationTarget& target, const std::vector<std::vector<Real>>& observed);
/// The same of one part.
Real part_rms(const CalibrationTarget& target, const TargetPart& part, const std::vector<Real>& observed);

}  // namespace gracilis
