#include <gracilis/draft/given_attachments.hpp>

#include <gracilis/anatomy/attachments/attachment_patch.hpp>
#include <gracilis/core/median.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

namespace gracilis {
namespace {

constexpr std::array<Real, 7> patch_reaches = {0.003, 0.004, 0.005, 0.006, 0.008, 0.01, 0.015};
constexpr Real near_part = 0.006;                           // m, of a patch from a part of its muscle
constexpr Real far_from_muscle = 0.025, near_bone = 0.008;  // m, of landmarks

bool has(const std::vector<Zone>& zones, std::size_t bone) {
  return std::any_of(zones.begin(), zones.end(), [&](const Zone& zone) { return zone.bone == bone; });
}

std::vector<const NearestTriangle*> all_trees(const BoneParts& bones) {
  std::vector<const NearestTriangle*> trees;
  for (std::size_t b = 0; b < bones.count(); ++b) trees.push_back(&bones.tree(b));
  return trees;
}

const std::set<std::string> origin_words = {"ori", "origin", "origo", "origins", "proximal"};
const std::set<std::string> insertion_words = {"ins", "insertion", "insertio", "insertions", "distal"};

std::optional<AttachmentEnd> end_in(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (origin_words.contains(word)) return AttachmentEnd::origin;
    if (insertion_words.contains(word)) return AttachmentEnd::insertion;
  }
  return std::nullopt;
}

/// How landmarks hang together: whether each follows the one before, and whether the last comes back to the first.
struct Spacing {
  LineKind line = LineKind::cloud;
  Real largest = 0;  ///< m, from any to its nearest neighbor
};

Spacing spacing_of(const Points& points) {
  std::vector<Real> steps, nearest;
  for (Index i = 0; i < points.cols(); ++i) {
    Real least = std::numeric_limits<Real>::infinity();
    for (Index j = 0; j < points.cols(); ++j)
      if (j != i) least = std::min(least, (points.col(i) - points.col(j)).norm());
    nearest.push_back(least);
    if (i > 0) steps.push_back((points.col(i) - points.col(i - 1)).norm());
  }
  Spacing spacing;
  if (points.cols() < 3) return spacing;
  spacing.largest = *std::max_element(nearest.begin(), nearest.end());
  if (median(steps) > 1.5 * median(nearest)) return spacing;
  const Real closing = (points.col(0) - points.col(points.cols() - 1)).norm();
  const bool closed = points.cols() > 4 && closing < 2.5 * median(steps);
  spacing.line = closed ? LineKind::closed : LineKind::open;
  return spacing;
}

/// The bone that a cloud lies on; none where all are far.
std::optional<std::size_t> bone_under(const Points& points, const BoneParts& bones) {
  std::optional<std::size_t> best;
  Real least = near_bone;
  for (std::size_t b = 0; b < bones.count(); ++b) {
    std::vector<Real> distances;
    for (const auto& p : points.colwise()) distances.push_back(bones.tree(b).query(p).distance);
    if (const Real distance = median(distances); distance < least) least = distance, best = b;
  }
  return best;
}

bool lies_near(const Points& points, const NearestTriangle& muscle) {
  std::vector<Real> distances;
  for (const auto& p : points.colwise()) distances.push_back(muscle.query(p).distance);
  return median(distances) < far_from_muscle;
}

/// Whether a muscle is a part of another: it has that one's name and more, and one of its tendons.
bool is_head_of(const KnownMuscle& head, const KnownMuscle& whole) {
  const std::vector<KnownTendon>& tendons = dictionary().tendons;
  return head.name.starts_with(whole.name + "_") && std::any_of(tendons.begin(), tendons.end(), [&](const auto& each) {
           return each.joins(head) && each.joins(whole);
         });
}

/// m, how far from a muscle a patch may lie; 0: it is another's. Where no muscle has the patch's name, pieces and heads
/// of what it is named after take it, or the whole, if they are near.
Real farthest_from(const FoundPatch& patch, const FoundMuscle& muscle, const FoundFolder& found) {
  if (patch.muscle == muscle.name) return patch_reaches.back();
  if (!patch.known || !muscle.known || patch.side != muscle.side) return 0;
  if (std::any_of(found.muscles.begin(), found.muscles.end(), [&](const auto& m) { return m.name == patch.muscle; }))
    return 0;
  const bool is_related =
      muscle.known == patch.known || is_head_of(*muscle.known, *patch.known) || is_head_of(*patch.known, *muscle.known);
  return is_related ? near_part : 0;
}

/// Widens the distance to the patch until it holds enough.
void hold_by_patch(DraftAttachment& attachment, const TriangleMesh& patch, Real farthest, const MuscleEnds& ends) {
  const NearestTriangle tree(patch);
  const std::vector<const NearestTriangle*> of_patch = {&tree};
  for (const Real reach : patch_reaches) {
    if (reach > farthest) return;
    attachment.landmark_distance = reach;
    attachment.vertices = select_vertices(ends.surface(), of_patch, NearBone{reach});
    if (ends.is_enough(attachment.vertices)) return;
  }
}

/// Widens the rule's distances until it holds enough.
void hold_by_landmarks(DraftAttachment& attachment, const std::optional<std::size_t>& bone, const BoneParts& bones,
                       const MuscleEnds& ends) {
  const Spacing spacing = spacing_of(attachment.points);
  attachment.line = bone ? spacing.line : LineKind::cloud;
  const std::vector<LandmarkSet> sets = {{attachment.points, attachment.line}};
  const Real reach = bone ? std::clamp(1.2 * spacing.largest, 0.008, 0.012) : 0.012;
  for (const Real wider : {1.0, 1.3, 1.7, 2.2, 3.0}) {
    attachment.landmark_distance = std::ceil(reach * wider * 1000) / 1000;
    attachment.bone_distance = bone ? std::ceil(0.004 * wider * 1000) / 1000 : 0;
    const std::vector<const NearestTriangle*> trees =
        bone ? std::vector{&bones.tree(*bone)} : std::vector<const NearestTriangle*>{};
    attachment.vertices =
        bone ? select_vertices(ends.surface(), trees,
                               NearLandmarks{sets, attachment.bone_distance, attachment.landmark_distance})
             : select_vertices(ends.surface(), trees, NearPoints{sets, attachment.landmark_distance});
    if (ends.is_enough(attachment.vertices)) return;
  }
}

}  // namespace

AttachmentEnd end_on(std::size_t bone, const MuscleSites& sites, const BoneParts& bones, const Skeleton& skeleton) {
  const bool at_origin = has(sites.origin.zones, bone), at_insertion = has(sites.insertion.zones, bone);
  if (at_origin != at_insertion) return at_origin ? AttachmentEnd::origin : AttachmentEnd::insertion;
  const std::string& body = bones.body(bone);
  const auto among = [&](const EndSites& end) {
    return std::find(end.bodies.begin(), end.bodies.end(), body) != end.bodies.end();
  };
  if (among(sites.origin) != among(sites.insertion))
    return among(sites.origin) ? AttachmentEnd::origin : AttachmentEnd::insertion;
  const auto depth = [&](const EndSites& end) { return end.bodies.empty() ? 0 : skeleton.depth(end.bodies.front()); };
  return skeleton.depth(body) <= depth(sites.origin) ? AttachmentEnd::origin : AttachmentEnd::insertion;
}

std::vector<DraftAttachment> from_patches(const FoundMuscle& muscle, const FoundFolder& found, const MuscleSites& sites,
                                          const BoneParts& bones, const Skeleton& skeleton, const MuscleEnds& ends) {
  std::vector<DraftAttachment> result;
  const std::vector<const NearestTriangle*> trees = all_trees(bones);
  for (const FoundPatch& patch : found.patches) {
    const Real farthest = farthest_from(patch, muscle, found);
    if (farthest == 0 || patch.mesh.face_count() == 0) continue;
    const std::vector<std::size_t> under = bones_under(patch.mesh, trees);
    const std::optional<AttachmentEnd> said = end_in(patch.words);
    std::map<std::pair<AttachmentEnd, std::string>, std::set<std::size_t>> groups;
    for (const std::size_t bone : under)
      groups[{said ? *said : end_on(bone, sites, bones, skeleton), bones.body(bone)}].insert(bone);
    for (const auto& [place, on] : groups) {
      std::vector<char> keep;
      for (const std::size_t bone : under) keep.push_back(on.contains(bone));
      DraftAttachment attachment;
      attachment.end = place.first;
      attachment.body = place.second;
      for (const std::size_t bone : on) attachment.bones.push_back(bones.bone(bone).name);
      attachment.patch = attachment.given_by = patch.file;
      attachment.part = patch.part;
      hold_by_patch(attachment, kept_faces(patch.mesh, keep), farthest, ends);
      const bool is_part = patch.muscle != muscle.name;
      if (attachment.vertices.empty() || (is_part && !ends.is_enough(attachment.vertices))) continue;
      attachment.guess = {"",
                          fmt::format("{} on {}, within {:g} mm",
                                      is_part ? "pieces of the patch of " + patch.muscle : "the patch's pieces",
                                      fmt::join(attachment.bones, ", "), 1000 * attachment.landmark_distance),
                          attachment.landmark_distance < 0.007 && !is_part ? 0.95 : 0.7};
      result.push_back(std::move(attachment));
    }
  }
  return result;
}

std::vector<DraftAttachment> from_landmarks(const FoundMuscle& muscle, const Landmarks& landmarks,
                                            const MuscleSites& sites, const BoneParts& bones, const Skeleton& skeleton,
                                            const MuscleEnds& ends, bool is_mirrored) {
  std::vector<DraftAttachment> result;
  if (!muscle.known || landmarks.empty()) return result;
  const NearestTriangle surface(ends.surface());
  for (const LandmarkCloud& cloud : landmarks) {
    const NameWords words = read_name(cloud.name, dictionary().words);
    const BodySide side = is_mirrored ? other_side(words.side) : words.side;
    if (side != BodySide::none && side != muscle.side) continue;
    if (find_muscle(words).known != muscle.known || !lies_near(cloud.points, surface)) continue;
    const std::optional<std::size_t> bone = bone_under(cloud.points, bones);
    const std::optional<AttachmentEnd> said = end_in(words.words);
    if (!said && !bone) continue;
    DraftAttachment attachment;
    attachment.end = said ? *said : end_on(*bone, sites, bones, skeleton);
    if (!bone && sites.at(attachment.end).bodies.empty()) continue;
    attachment.body = bone ? bones.body(*bone) : sites.at(attachment.end).bodies.front();
    if (bone) attachment.bones = {bones.bone(*bone).name};
    attachment.cloud = cloud.name;
    attachment.points = cloud.points;
    hold_by_landmarks(attachment, bone, bones, ends);
    if (attachment.vertices.empty()) continue;
    attachment.guess = {"",
                        bone ? "landmarks '" + cloud.name + "' on " + attachment.bones.front()
                             : "landmarks '" + cloud.name + "' on no bone that is here, moved with " + attachment.body,
                        bone ? 0.9 : 0.6};
    result.push_back(std::move(attachment));
  }
  return result;
}

}  // namespace gracilis
