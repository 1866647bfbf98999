#include <gracilis/simulate/gates.hpp>

#include <gracilis/simulate/measures.hpp>

#include <cmath>
#include <cstdio>
#include <limits>

namespace gracilis {

namespace {

/// printf into a string.
template <class... Values>
std::string text_of(const char* form, Values... values) {
  char text[160];
  std::snprintf(text, sizeof text, form, values...);
  return text;
}

std::string in_parentheses(const std::string& name) { return name.empty() ? "" : " (" + name + ")"; }

std::string depth_text(const std::string& what, Real metres, Real limit) {
  return what + text_of(" %.3f mm beyond rest (limit %.1f mm)", metres * 1e3, limit * 1e3);
}

}  // namespace

std::vector<MissedGate> gates_missed_by(const MuscleMeasures& measures, const QualityGates& gates) {
  std::vector<MissedGate> missed;
  if (!measures.finite)
    missed.push_back({"a vertex position is not finite", "nothing of this frame can be used",
                      std::numeric_limits<Real>::infinity()});
  if (measures.level == MeasureLevel::none) return missed;
  const Real volume_change = std::abs(measures.volume_ratio - 1);
  if (volume_change > gates.volume)
    missed.push_back(
        {text_of("volume %.2f %% of rest (limit 100 ± %.1f %%)", measures.volume_ratio * 100, gates.volume * 100),
         "muscles keep their volume, so its thickness there is off", volume_change / gates.volume});
  // What a level leaves unmeasured is as at rest, and misses nothing.
  const char* in_bone = "muscle would show inside the bone";
  if (measures.vertex_depth_beyond_rest > gates.vertex_depth)
    missed.push_back({depth_text("a vertex in a bone", measures.vertex_depth_beyond_rest, gates.vertex_depth), in_bone,
                      measures.vertex_depth_beyond_rest / gates.vertex_depth});
  if (measures.midpoint_depth_beyond_rest > gates.midpoint_depth)
    missed.push_back(
        {depth_text("an edge's midpoint in a bone", measures.midpoint_depth_beyond_rest, gates.midpoint_depth), in_bone,
         measures.midpoint_depth_beyond_rest / gates.midpoint_depth});
  if (measures.muscle_depth_beyond_rest > gates.muscle_depth)
    missed.push_back({depth_text("a vertex in another muscle" + in_parentheses(measures.deepest_in),
                                 measures.muscle_depth_beyond_rest, gates.muscle_depth),
                      "one muscle would show inside the other",
                      measures.muscle_depth_beyond_rest / gates.muscle_depth});
  if (measures.edge_ratio_max_free > gates.free_edge_ratio)
    missed.push_back({text_of("an edge far from attachments stretched %.1f times (limit %.1f)",
                              measures.edge_ratio_max_free, gates.free_edge_ratio),
                      "the surface is drawn out there, and its shape says nothing",
                      measures.edge_ratio_max_free / gates.free_edge_ratio});
  if (measures.edge_ratio_max_near > gates.near_edge_ratio)
    missed.push_back({text_of("an edge near an attachment stretched %.1f times (limit %.1f)",
                              measures.edge_ratio_max_near, gates.near_edge_ratio),
                      "the surface is drawn out to a fin there", measures.edge_ratio_max_near / gates.near_edge_ratio});
  if (measures.spike > gates.spike)
    missed.push_back({text_of("a vertex stands out by %.1f edges (limit %.1f)", measures.spike, gates.spike),
                      "the surface has a spike or a tangle there", measures.spike / gates.spike});
  if (measures.thickening > gates.thickening)
    missed.push_back(
        {text_of("%.1f times as thick as at rest somewhere (limit %.1f)", measures.thickening, gates.thickening),
         "it bulges to a knob or a rim there", measures.thickening / gates.thickening});
  if (measures.thinning > gates.thinning)
    missed.push_back(
        {text_of("%.1f times as thin as at rest somewhere (limit %.1f)", measures.thinning, gates.thinning),
         "it is pressed to a sheet there", measures.thinning / gates.thinning});
  if (measures.belly_off_place > gates.belly_off_place)
    missed.push_back({text_of("the belly is %.1f mm off its place (limit %.0f mm)", measures.belly_off_place * 1e3,
                              gates.belly_off_place * 1e3),
                      "it has slipped along or around the bones", measures.belly_off_place / gates.belly_off_place});
  // No line may be on the wrong side, so nothing is a multiple of that limit: a tenth of them counts as twice.
  if (measures.wrong_side > gates.wrong_side)
    missed.push_back({text_of("%.0f %% of its lines pass a bone on the wrong side (limit %.0f %%)",
                              measures.wrong_side * 100, gates.wrong_side * 100),
                      "moment arms of these lines have another size or sign", 1 + 10 * measures.wrong_side});
  if (measures.slack > gates.slack)
    missed.push_back(
        {text_of("its lines are %.0f %% longer than taut (limit %.0f %%)", measures.slack * 100, gates.slack * 100),
         "its lengths are too long there", measures.slack / gates.slack});
  return missed;
}

std::vector<std::string> missed_gates(const MuscleMeasures& measures, const QualityGates& gates) {
  std::vector<std::string> texts;
  for (const MissedGate& missed : gates_missed_by(measures, gates)) texts.push_back(missed.text);
  return texts;
}

std::vector<std::string> unmeasured_gates(MeasureLevel level) {
  std::vector<std::string> names;
  if (level == MeasureLevel::none) names = {"volume", "stretch"};
  if (level != MeasureLevel::full)
    names.insert(names.end(), {"depth in bones", "depth in muscles", "place", "side of bones", "slack"});
  return names;
}

std::string name_of(MeasureLevel level) {
  return level == MeasureLevel::none ? "none" : level == MeasureLevel::light ? "light" : "full";
}

std::optional<MeasureLevel> measure_level_called(const std::string& name) {
  for (const MeasureLevel level : measure_levels)
    if (name == name_of(level)) return level;
  return std::nullopt;
}

}  // namespace gracilis
