#pragma once

#include <gracilis/core/types.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gracilis {

struct MuscleMeasures;

/// The bars ("gates") that a frame must meet; `gracilis run` warns where they are missed.
struct QualityGates {
  Real volume = 0.005;         ///< |volume ratio - 1|
  Real vertex_depth = 1e-4;    ///< m beyond rest
  Real midpoint_depth = 5e-4;  ///< m beyond rest
  Real muscle_depth = 1e-3;    ///< m in another muscle beyond rest
  Real free_edge_ratio = 3;
  Real near_edge_ratio = 5;      ///< within 15 mm of attachments, where tendons are drawn around bones
  Real spike = 2;                ///< edge lengths, see SurfaceFlaws
  Real thickening = 3;           ///< × rest
  Real thinning = 5;             ///< rest over now
  Real belly_off_place = 0.018;  ///< m
  Real wrong_side = 0;           ///< share of lines
  Real slack = 0.15;             ///< share of what the length must be
};

/// How much of a muscle is measured: nothing; its shape alone (volume, edges, angles); or also how deep it lies in
/// bones and other muscles and where it runs and lies, which takes as long as some methods do.
enum class MeasureLevel { none, light, full };
inline constexpr std::array<MeasureLevel, 3> measure_levels = {MeasureLevel::none, MeasureLevel::light,
                                                               MeasureLevel::full};

/// A gate that a muscle misses.
struct MissedGate {
  std::string text;         ///< the value and its limit, in words
  std::string consequence;  ///< why it matters, in words
  Real excess = 1;          ///< how many times the limit the value is; for orders only
};

/// The gates that a muscle misses; empty when it meets all that were measured.
std::vector<MissedGate> gates_missed_by(const MuscleMeasures& measures, const QualityGates& gates);

/// Their texts alone.
std::vector<std::string> missed_gates(const MuscleMeasures& measures, const QualityGates& gates);

/// What a level leaves unmeasured, as in "depth in bones"; empty for full.
std::vector<std::string> unmeasured_gates(MeasureLevel level);

/// "none", "light" or "full".
std::string name_of(MeasureLevel level);
/// The level of that name, if there is one.
std::optional<MeasureLevel> measure_level_called(const std::string& name);

}  // namespace gracilis
