#include <gracilis/anatomy/overlap/overlap_report.hpp>

#include <gracilis/anatomy/overlap/overlap_sides.hpp>
#include <gracilis/anatomy/overlap/rest_overlap.hpp>
#include <gracilis/anatomy/sections/sheet.hpp>
#include <gracilis/core/parallel.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

/// Pairs that a warning names.
constexpr std::size_t most_named = 3;
/// What scans of touching surfaces leave is less, and no word is lost about it, m.
constexpr Real deeper_than_scans = 0.001;
/// What lies deeper in a bone is more likely misplaced than drawn roughly, m.
constexpr Real misplaced = 0.01;

/// With one digit after the point.
std::string millimeters(Real length) {
  const long tenths = std::lround(length * 1e4);
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " mm";
}

std::string name_of(const MuscleOverlap& pair) {
  const bool first_is_in = pair.first_deepest >= pair.second_deepest;
  return (first_is_in ? pair.first : pair.second) + " in " + (first_is_in ? pair.second : pair.first) + " (" +
         millimeters(pair.deepest()) + ")";
}

/// As many as a warning names, separated by commas.
std::string first_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most_named, names.size()); ++i) text += (i > 0 ? ", " : "") + names[i];
  return text;
}

}  // namespace

OverlapReport report_overlaps(const Scene& scene) {
  const std::vector<RestOverlap> overlaps = rest_overlaps(scene);
  OverlapReport report;
  report.vertices = count_inside(overlaps);
  std::vector<std::vector<char>> in_tendon;
  for (const Muscle& muscle : scene.muscles) {
    report.of_vertices += muscle.surface.vertex_count();
    in_tendon.push_back(in_tendons(muscle));
  }
  report.pairs.resize(overlaps.size());
  parallel_for_each(overlaps.size(), [&](std::size_t i) {
    const RestOverlap& overlap = overlaps[i];
    const Muscle &first = scene.muscles[static_cast<std::size_t>(overlap.first)],
                 &second = scene.muscles[static_cast<std::size_t>(overlap.second)];
    report.pairs[i] = {first.name,
                       second.name,
                       static_cast<Index>(overlap.of_first.vertices.size()),
                       static_cast<Index>(overlap.of_second.vertices.size()),
                       overlap.of_first.deepest(),
                       overlap.of_second.deepest(),
                       overlap_sides(overlap, {first.surface, in_tendon[static_cast<std::size_t>(overlap.first)]},
                                     {second.surface, in_tendon[static_cast<std::size_t>(overlap.second)]})
                           .is_through};
  });
  for (const BoneOverlap& overlap : rest_overlaps_with_bones(scene))
    report.in_bones.push_back({scene.muscles[static_cast<std::size_t>(overlap.muscle)].name,
                               scene.bones[static_cast<std::size_t>(overlap.bone)].name,
                               static_cast<Index>(overlap.inside.vertices.size()), overlap.inside.deepest()});
  std::stable_sort(report.in_bones.begin(), report.in_bones.end(),
                   [](const MuscleInBone& l, const MuscleInBone& r) { return l.deepest > r.deepest; });
  std::stable_sort(report.pairs.begin(), report.pairs.end(),
                   [](const MuscleOverlap& l, const MuscleOverlap& r) { return l.deepest() > r.deepest(); });
  return report;
}

/// What lies in bones, in one line; empty where nothing lies deep.
static std::string bone_warning(const std::vector<MuscleInBone>& in_bones) {
  std::vector<std::string> deep;
  for (const MuscleInBone& each : in_bones)
    if (each.deepest > deeper_than_scans)
      deep.push_back(each.muscle + " in " + each.bone + " (" + millimeters(each.deepest) + ")");
  if (deep.empty()) return {};
  return "muscles lie in bones in the capture pose, in " + std::to_string(deep.size()) +
         (deep.size() == 1 ? " pair" : " pairs") + "; deepest " + first_of(deep) + "; they stay as deep as they are" +
         (in_bones.front().deepest > misplaced ? ", and what moves there tears: check places and units of both surfaces"
                                               : "");
}

/// Which pairs pass through each other, in one line; empty where none does.
static std::string through_warning(const std::vector<MuscleOverlap>& pairs) {
  std::vector<std::string> through;
  for (const MuscleOverlap& pair : pairs)
    if (pair.is_through)
      through.push_back(pair.first + " and " + pair.second + " (" + millimeters(pair.deepest()) + ")");
  if (through.empty()) return {};
  return "pairs that pass through each other in the capture pose: " + std::to_string(through.size()) + ", deepest " +
         first_of(through) +
         "; nothing tells which side of the other is whose, so contact can only keep them as deep as they are there";
}

std::vector<std::string> overlap_warnings(const OverlapReport& report) {
  std::vector<std::string> warnings;
  if (const std::string in_bones = bone_warning(report.in_bones); !in_bones.empty()) warnings.push_back(in_bones);
  if (report.pairs.empty()) return warnings;
  std::vector<std::string> pairs;
  for (const MuscleOverlap& pair : report.pairs) pairs.push_back(name_of(pair));
  warnings.push_back("muscles overlap in the capture pose: " + std::to_string(report.vertices) + " of " +
                     std::to_string(report.of_vertices) + " vertices lie in another muscle, in " +
                     std::to_string(report.pairs.size()) + (report.pairs.size() == 1 ? " pair" : " pairs") +
                     "; deepest " + first_of(pairs));
  if (const std::string through = through_warning(report.pairs); !through.empty()) warnings.push_back(through);
  return warnings;
}

}  // namespace gracilis
