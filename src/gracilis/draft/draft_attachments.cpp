#include <gracilis/draft/draft_attachments.hpp>

#include <gracilis/draft/end_contact.hpp>
#include <gracilis/draft/given_attachments.hpp>
#include <gracilis/draft/surface_as_read.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace gracilis {
namespace {

/// m from its bone: an end so far would be carried about by it as on a rod, which a tendon is not.
constexpr Real missing_tendon = 0.03;
constexpr Real not_there = std::numeric_limits<Real>::infinity();

Points positions(const TriangleMesh& mesh, const std::vector<Index>& vertices) {
  return mesh.vertices(Eigen::all, vertices);
}

/// Drafts one muscle's ends.
struct EndsDraft {
  const FoundMuscle& muscle;
  const FoundFolder& found;
  const Skeleton& skeleton;
  const BoneParts& bones;
  MuscleEnds ends;
  MuscleSites sites = {};
  std::vector<DraftAttachment> drafted = {};

  bool has_end(AttachmentEnd end) const {
    return std::any_of(drafted.begin(), drafted.end(), [&](const DraftAttachment& each) { return each.end == end; });
  }

  std::vector<Index> all_held() const {
    std::set<Index> all;
    for (const DraftAttachment& each : drafted) all.insert(each.vertices.begin(), each.vertices.end());
    return {all.begin(), all.end()};
  }

  DraftAttachment on_bones(AttachmentEnd end, const HeldVertices& held) const {
    DraftAttachment attachment;
    attachment.end = end;
    for (const std::size_t bone : held.bones) attachment.bones.push_back(bones.bone(bone).name);
    attachment.body = bones.body(held.bones.front());
    attachment.bone_distance = attachment.from_bone = held.distance;
    attachment.vertices = held.vertices;
    return attachment;
  }

  std::map<std::string, std::vector<Zone>> by_body(const std::vector<Zone>& zones) const {
    std::map<std::string, std::vector<Zone>> groups;
    for (const Zone& zone : zones) groups[bones.body(zone.bone)].push_back(zone);
    return groups;
  }

  /// Whether these are, of all that one end touches, the only ones at one of the muscle's two tips: a back muscle that
  /// lies close to the vertebrae on its way still ends on the sacrum.
  bool reaches_tip(const DraftAttachment& held, const std::vector<DraftAttachment>& nearer) const {
    const auto at = [](const DraftAttachment& each, const HeldVertices& tip) {
      return std::any_of(each.vertices.begin(), each.vertices.end(),
                         [&](Index v) { return std::binary_search(tip.vertices.begin(), tip.vertices.end(), v); });
    };
    const std::vector<HeldVertices> tips = ends.both_ends();
    return std::any_of(tips.begin(), tips.end(), [&](const HeldVertices& tip) {
      return at(held, tip) &&
             std::none_of(nearer.begin(), nearer.end(), [&](const DraftAttachment& each) { return at(each, tip); });
    });
  }

  /// Where it touches the end's bones: on the body where it lies nearest, and on others where it lies as near, or ends.
  void touch(AttachmentEnd end) {
    std::vector<DraftAttachment> found_here;
    for (const auto& [body, zones] : by_body(sites.at(end).zones)) {
      const HeldVertices held = ends.touching(bones, zones);
      if (held.vertices.empty()) continue;
      found_here.push_back(on_bones(end, held));
      const Real near = held.distance < 0.0035 ? 0.8 : held.distance < 0.0065 ? 0.65 : 0.45;
      found_here.back().guess = {
          "", fmt::format("within {:g} mm of {}", 1000 * held.distance, fmt::join(found_here.back().bones, ", ")),
          near * (muscle.known ? muscle.certainty / 0.95 : 0.7)};
    }
    Real nearest = std::numeric_limits<Real>::infinity();
    for (const DraftAttachment& each : found_here) nearest = std::min(nearest, each.bone_distance);
    std::stable_sort(found_here.begin(), found_here.end(), [](const DraftAttachment& a, const DraftAttachment& b) {
      return a.bone_distance < b.bone_distance;
    });
    std::vector<DraftAttachment> taken;
    for (DraftAttachment& each : found_here)
      if (each.bone_distance <= nearest + 0.002 || reaches_tip(each, taken)) taken.push_back(std::move(each));
    std::move(taken.begin(), taken.end(), std::back_inserter(drafted));
  }

  /// What both ends hold alike, as of a muscle from vertebra to vertebra, is of the one whose tip is nearer; the origin
  /// is towards the bodies that hang on fewer joints.
  void tell_ends_apart() {
    const auto has_twin = [&](const DraftAttachment& each) {
      return std::any_of(drafted.begin(), drafted.end(), [&](const DraftAttachment& other) {
        return other.end != each.end && other.body == each.body && other.vertices == each.vertices;
      });
    };
    if (std::none_of(drafted.begin(), drafted.end(), has_twin)) return;
    const Eigen::VectorXd share = ends.share_between_ends();
    Eigen::VectorXd places(static_cast<Index>(drafted.size())), depths(places.size());
    for (Index i = 0; i < places.size(); ++i) {
      const DraftAttachment& each = drafted[static_cast<std::size_t>(i)];
      places[i] = share(each.vertices).mean();
      depths[i] = skeleton.depth(each.body);
    }
    const Real deeper = (places.array() - places.mean()).matrix().dot((depths.array() - depths.mean()).matrix());
    if (deeper == 0) return;
    std::vector<DraftAttachment> kept;
    for (std::size_t i = 0; i < drafted.size(); ++i) {
      const bool at_first = places[static_cast<Index>(i)] < 0.5;
      const AttachmentEnd nearer = at_first == (deeper > 0) ? AttachmentEnd::origin : AttachmentEnd::insertion;
      if (!has_twin(drafted[i]) || drafted[i].end == nearer) kept.push_back(drafted[i]);
    }
    const auto holds = [&](AttachmentEnd end) {
      return std::any_of(kept.begin(), kept.end(), [&](const DraftAttachment& each) { return each.end == end; });
    };
    if (holds(AttachmentEnd::origin) && holds(AttachmentEnd::insertion)) drafted = std::move(kept);
  }

  /// The body of the bone nearest to the middle of some vertices.
  std::string body_beside(const std::vector<Index>& vertices) const {
    const Vec3 middle = positions(ends.surface(), vertices).rowwise().mean();
    std::size_t nearest = 0;
    for (std::size_t b = 1; b < bones.count(); ++b)
      if (bones.tree(b).query(middle).distance < bones.tree(nearest).query(middle).distance) nearest = b;
    return bones.body(nearest);
  }

  /// What is nearest to the end's bones, or, where they are not here, the end that is farthest from what is held.
  void reach(AttachmentEnd end) {
    const EndSites& wanted = sites.at(end);
    if (!wanted.zones.empty()) {
      const HeldVertices held = ends.nearest(bones, wanted.zones);
      if (held.vertices.empty()) return;
      DraftAttachment attachment = on_bones(end, held);
      const std::string bone = attachment.bones.front();
      const bool far = held.distance > missing_tendon * found.size;
      if (far) attachment.body = body_beside(held.vertices);
      attachment.guess = {
          "",
          fmt::format("hardly touches {}: what is nearest, {:.0f} mm from {}{}", wanted.wanted, 1000 * held.distance,
                      bone, far ? "; its tendon is missing, so it moves with " + attachment.body : ""),
          far ? 0.2 : 0.35};
      attachment.bones.clear();
      attachment.bone_distance = 0;
      attachment.from_bone = not_there;
      drafted.push_back(std::move(attachment));
    } else if (!wanted.bodies.empty() && !drafted.empty()) {
      const HeldVertices held = ends.farthest(all_held());
      if (held.vertices.empty()) return;
      DraftAttachment attachment;
      attachment.end = end;
      attachment.body = wanted.bodies.front();
      attachment.vertices = held.vertices;
      attachment.from_bone = not_there;
      attachment.guess = {
          "",
          fmt::format("{} is not here: the end farthest from the other, moved with {}", wanted.wanted, attachment.body),
          0.35};
      drafted.push_back(std::move(attachment));
    }
  }

  /// A muscle of no known name: the two bodies that it touches most, the one nearer to the trunk its origin.
  void touch_any() {
    std::vector<DraftAttachment> touched;
    std::vector<Zone> all;
    for (std::size_t b = 0; b < bones.count(); ++b) all.push_back({b, {bones.bone(b).name}});
    for (const auto& [body, zones] : by_body(all)) {
      const HeldVertices held = ends.touching(bones, zones);
      if (held.vertices.empty() || held.distance > 0.0065) continue;
      touched.push_back(on_bones(AttachmentEnd::origin, held));
      touched.back().guess = {"",
                              fmt::format("its name is unknown: within {:g} mm of {}", 1000 * held.distance,
                                          fmt::join(touched.back().bones, ", ")),
                              0.4};
    }
    std::sort(touched.begin(), touched.end(),
              [](const DraftAttachment& a, const DraftAttachment& b) { return a.vertices.size() > b.vertices.size(); });
    if (touched.size() < 2) return;
    touched.resize(2);
    const bool turned = skeleton.depth(touched[0].body) > skeleton.depth(touched[1].body);
    touched[turned ? 0 : 1].end = AttachmentEnd::insertion;
    drafted = std::move(touched);
  }

  /// How far the body's nearest bone is.
  Real to_body(const std::string& body, const Vec3& p) const {
    Real least = std::numeric_limits<Real>::max();
    for (std::size_t b = 0; b < bones.count(); ++b)
      if (bones.body(b) == body) least = std::min(least, bones.tree(b).query(p).distance);
    return least;
  }

  /// Of two that hold the same vertices each keeps those nearer to its body, a third of them at least.
  void divide(DraftAttachment& first, DraftAttachment& second) const {
    std::vector<std::pair<Real, Index>> order;  // by how much farther the first's body is
    for (const Index v : first.vertices) {
      const Vec3 p = ends.surface().vertices.col(v);
      order.emplace_back(to_body(first.body, p) - to_body(second.body, p), v);
    }
    std::sort(order.begin(), order.end());
    const auto nearer = std::count_if(order.begin(), order.end(), [](const auto& each) { return each.first < 0; });
    const std::size_t least = (order.size() + 1) / 3;
    const std::size_t cut = std::clamp(static_cast<std::size_t>(nearer), least, order.size() - least);
    first.vertices.clear(), second.vertices.clear();
    for (std::size_t i = 0; i < order.size(); ++i) (i < cut ? first : second).vertices.push_back(order[i].second);
    for (DraftAttachment* each : {&first, &second}) {
      std::sort(each->vertices.begin(), each->vertices.end());
      each->trimmed = true;
    }
  }

  /// A vertex moves with one body: with that of the smaller attachment, which can spare none.
  void keep_apart() {
    for (std::size_t i = 0; i < drafted.size(); ++i)
      for (std::size_t j = i + 1; j < drafted.size(); ++j) {
        if (drafted[i].body == drafted[j].body) continue;
        if (drafted[i].vertices == drafted[j].vertices) {
          divide(drafted[i], drafted[j]);
          continue;
        }
        DraftAttachment *larger = &drafted[i], *smaller = &drafted[j];
        if (larger->vertices.size() < smaller->vertices.size()) std::swap(larger, smaller);
        const auto taken = std::erase_if(larger->vertices, [&](Index v) {
          return std::binary_search(smaller->vertices.begin(), smaller->vertices.end(), v);
        });
        larger->trimmed |= taken > 0;
      }
    std::erase_if(drafted, [](const DraftAttachment& each) { return each.vertices.empty(); });
  }

  std::vector<const NearestTriangle*> trees_under(const DraftAttachment& attachment) const {
    std::vector<const NearestTriangle*> trees;
    for (std::size_t b = 0; b < bones.count(); ++b)
      if (std::find(attachment.bones.begin(), attachment.bones.end(), bones.bone(b).name) != attachment.bones.end())
        trees.push_back(&bones.tree(b));
    return trees;
  }

  /// The vertices that a scene's reader would take by the attachment's distances.
  std::vector<Index> by_rule(const DraftAttachment& attachment) const {
    return select_vertices(ends.surface(), trees_under(attachment), NearBone{attachment.bone_distance});
  }

  /// Names the vertices by a cloud at their places, where distances alone would take others.
  void write_down(DraftAttachment& attachment) const {
    if (!attachment.patch.empty() || !attachment.cloud.empty()) {
      if (!attachment.trimmed) return;
      attachment.patch.clear();
      attachment.line = LineKind::cloud;
      attachment.bone_distance = 0;
    } else if (!attachment.bones.empty() && by_rule(attachment) == attachment.vertices) {
      return;
    }
    attachment.cloud = muscle.name + "_" + attachment.name;
    const SurfaceAsRead read(ends.surface());
    attachment.points = read.places(attachment.vertices);
    attachment.landmark_distance = read.reach_of(attachment.points, own_vertices);
    if (attachment.bone_distance == 0) return attachment.bones.clear();
    // What came between two vertices may lie farther from a hollow bone than both.
    attachment.bone_distance = distance_to_all(attachment.points, trees_under(attachment), attachment.bone_distance);
  }

  void name_all() {
    std::set<std::string> names;
    for (DraftAttachment& each : drafted) {
      const bool origin = each.end == AttachmentEnd::origin;
      std::string name = each.bones.size() == 1 ? each.bones.front() : each.body;
      if (names.contains(name)) name += origin ? "_origin" : "_insertion";
      each.name = name;
      for (int n = 2; !names.insert(each.name).second; ++n) each.name = fmt::format("{}_{}", name, n);
      each.guess.subject = muscle.name + (origin ? " origin" : " insertion");
    }
  }
};

}  // namespace

std::vector<DraftAttachment> draft_attachments(const FoundMuscle& muscle, const FoundFolder& found,
                                               const Skeleton& skeleton, const BoneParts& bones,
                                               const Landmarks& landmarks, std::string& why) {
  EndsDraft draft{muscle, found, skeleton, bones, MuscleEnds(muscle.mesh, found.size)};
  if (muscle.known)
    draft.sites = {bones.end_sites(muscle.known->origin, muscle.side),
                   bones.end_sites(muscle.known->insertion, muscle.side)};
  draft.drafted = from_patches(muscle, found, draft.sites, bones, skeleton, draft.ends);
  if (draft.drafted.empty())
    draft.drafted = from_landmarks(muscle, landmarks, draft.sites, bones, skeleton, draft.ends, found.is_mirrored);
  const std::vector<AttachmentEnd> both = {AttachmentEnd::origin, AttachmentEnd::insertion};
  if (muscle.known) {
    for (const AttachmentEnd end : both)
      if (!draft.has_end(end)) draft.touch(end);
    // What is nearest to bones that are here comes first: the other end may be the one that is farthest from it.
    for (int round = 0; round < 2; ++round)
      for (const AttachmentEnd end : both)
        if (!draft.has_end(end)) draft.reach(end);
  } else if (draft.drafted.empty()) {
    draft.touch_any();
  }
  const auto lacks = [&](AttachmentEnd end) { return !draft.has_end(end); };
  if (const auto end = std::find_if(both.begin(), both.end(), lacks); end != both.end()) {
    why = muscle.known
              ? "no bone is here for its " + std::string(*end == AttachmentEnd::origin ? "origin" : "insertion") +
                    " (" + draft.sites.at(*end).wanted + ")"
              : "its name is unknown and it touches fewer than two bones that move against each other; rename "
                "it to a muscle's name";
    return {};
  }
  draft.tell_ends_apart();
  draft.keep_apart();
  if (std::any_of(both.begin(), both.end(), lacks)) {
    why = "its origin and insertion hold the same few vertices; give them patches, or its surface more triangles";
    return {};
  }
  draft.name_all();
  for (DraftAttachment& each : draft.drafted) draft.write_down(each);
  return std::move(draft.drafted);
}

}  // namespace gracilis
