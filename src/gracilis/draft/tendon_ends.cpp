#include <gracilis/draft/tendon_ends.hpp>

#include <gracilis/draft/end_contact.hpp>
#include <gracilis/draft/surface_as_read.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace gracilis {
namespace {

/// m; an end that comes so near to its bone stays there, and others may lie on it.
constexpr Real on_its_bone = 0.006;
/// Of the distance to its bone: an end that lies so near to a muscle lies on that instead.
constexpr Real much_nearer = 0.5;
/// m, within which an end lies on a muscle: tendons are drawn as apart from each other as from bones.
constexpr std::array<Real, 4> muscle_reaches = {0.003, 0.004, 0.005, 0.006};

/// A muscle to lie on, and with which vertices.
struct Place {
  std::size_t host = 0;
  std::vector<Index> vertices;
  Real distance = 0;  ///< m
};

struct TendonDraft {
  std::vector<DraftMuscle>& muscles;
  Real size;

  std::vector<const DraftAttachment*> at(std::size_t muscle, AttachmentEnd end) const {
    std::vector<const DraftAttachment*> found;
    for (const DraftAttachment& each : muscles[muscle].attachments)
      if (each.end == end) found.push_back(&each);
    return found;
  }

  Real from_bone(std::size_t muscle, AttachmentEnd end) const {
    Real least = std::numeric_limits<Real>::infinity();
    for (const DraftAttachment* each : at(muscle, end)) least = std::min(least, each->from_bone);
    return least;
  }

  bool lies_on_muscle(std::size_t muscle, AttachmentEnd end) const {
    const auto ends = at(muscle, end);
    return std::any_of(ends.begin(), ends.end(), [](const DraftAttachment* each) { return !each->muscle.empty(); });
  }

  /// Whether `upper` lies on `lower`, or on what lies on it.
  bool hangs_on(std::size_t upper, std::size_t lower) const {
    if (upper == lower) return true;
    for (const DraftAttachment& each : muscles[upper].attachments)
      for (std::size_t m = 0; m < muscles.size(); ++m)
        if (!each.muscle.empty() && muscles[m].found->name == each.muscle && hangs_on(m, lower)) return true;
    return false;
  }

  bool may_carry(std::size_t host, std::size_t guest, const KnownTendon& tendon, AttachmentEnd end) const {
    const FoundMuscle &above = *muscles[guest].found, &below = *muscles[host].found;
    return below.known && below.side == above.side && tendon.joins(*below.known) &&
           (lies_on_muscle(host, end) || from_bone(host, end) <= on_its_bone) && !hangs_on(host, guest);
  }

  /// What of the guest's outermost vertices lies on the muscle.
  std::optional<Place> place_on(std::size_t host, const MuscleEnds& guest, const HeldVertices& outermost) const {
    const NearestTriangle below(muscles[host].found->mesh);
    for (const Real reach : muscle_reaches) {
      Place place{host, {}, reach};
      for (const Index v : outermost.vertices)
        if (below.query(guest.surface().vertices.col(v)).distance <= reach) place.vertices.push_back(v);
      if (guest.is_enough(place.vertices)) return place;
    }
    return std::nullopt;
  }

  HeldVertices outermost(std::size_t muscle, const MuscleEnds& ends, AttachmentEnd end) const {
    std::set<Index> other;
    for (const DraftAttachment& each : muscles[muscle].attachments)
      if (each.end != end) other.insert(each.vertices.begin(), each.vertices.end());
    return ends.farthest({other.begin(), other.end()});
  }

  /// The nearest muscle of the tendon that the end lies on, the first named of several.
  std::optional<Place> find_place(std::size_t guest, const KnownTendon& tendon, AttachmentEnd end) const {
    const Real bone = from_bone(guest, end);
    std::optional<Place> best;
    std::optional<MuscleEnds> ends;
    HeldVertices held;
    for (const std::string& name : tendon.muscles)
      for (std::size_t host = 0; host < muscles.size(); ++host) {
        if (!may_carry(host, guest, tendon, end) || muscles[host].found->known->name != name) continue;
        if (!ends) held = outermost(guest, ends.emplace(muscles[guest].found->mesh, size), end);
        std::optional<Place> place = place_on(host, *ends, held);
        if (place && place->distance <= much_nearer * bone && (!best || place->distance < best->distance))
          best = std::move(place);
      }
    return best;
  }

  void lay(std::size_t guest, const Place& place, const KnownTendon& tendon, AttachmentEnd end) {
    const FoundMuscle &above = *muscles[guest].found, &below = *muscles[place.host].found;
    const Real bone = from_bone(guest, end);
    DraftAttachment laid;
    laid.end = end;
    laid.muscle = below.name;
    laid.name = below.name;
    laid.body = at(place.host, end).front()->body;
    laid.vertices = place.vertices;
    const SurfaceAsRead read(above.mesh);
    laid.points = read.places(place.vertices);
    laid.cloud = above.name + "_" + laid.name;
    const NearestTriangle host(SurfaceAsRead(below.mesh).mesh);
    const NearestTriangle* hosts[] = {&host};
    laid.muscle_distance = distance_to_all(laid.points, hosts, place.distance);
    laid.landmark_distance = read.reach_of(laid.points, own_vertices);
    laid.from_bone = bone;
    laid.guess = {
        above.name + (end == AttachmentEnd::origin ? " origin" : " insertion"),
        fmt::format(
            "within {:g} mm of {}; both share the {}; {}", 1000 * place.distance, below.name, tendon.name,
            std::isfinite(bone) ? fmt::format("its bone is {:g} mm away", 1000 * bone) : "its bone is out of reach"),
        (std::isfinite(bone) ? 0.5 : 0.7) * std::min(above.certainty, below.certainty) / 0.95};
    std::vector<DraftAttachment>& all = muscles[guest].attachments;
    std::erase_if(all, [&](const DraftAttachment& each) { return each.end == end; });
    all.push_back(std::move(laid));
  }

  /// Whether any end was laid on a muscle.
  bool pass() {
    bool any = false;
    for (const KnownTendon& tendon : dictionary().tendons) {
      const AttachmentEnd end = tendon.at_origin ? AttachmentEnd::origin : AttachmentEnd::insertion;
      for (std::size_t guest = 0; guest < muscles.size(); ++guest) {
        const KnownMuscle* known = muscles[guest].found->known;
        if (!known || !tendon.joins(*known) || lies_on_muscle(guest, end) || from_bone(guest, end) <= on_its_bone)
          continue;
        if (const std::optional<Place> place = find_place(guest, tendon, end))
          lay(guest, *place, tendon, end), any = true;
      }
    }
    return any;
  }
};

}  // namespace

void lay_on_muscles(std::vector<DraftMuscle>& muscles, Real size) {
  TendonDraft draft{muscles, size};
  // What was laid in one pass may carry others in the next.
  while (draft.pass()) {
  }
}

}  // namespace gracilis
