#include <gracilis/draft/muscle_heads.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/draft/sites.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/io/mesh/load_surface.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace gracilis {
namespace {

constexpr Real about_on_it = 0.002;  ///< m, of a grown person: heads may have been cut apart, or thinned
constexpr Real most_of_it = 0.8;     ///< of a head's vertices

/// By its name: gastrocnemius_medial_r is a head of gastrocnemius_r.
bool is_called_a_head_of(const FoundMuscle& head, const FoundMuscle& whole) {
  return head.known && whole.known && head.side == whole.side && whole.known->name != head.known->name &&
         head.known->name.starts_with(whole.known->name + "_");
}

std::vector<std::string> heads_of(const FoundMuscle& whole, const FoundFolder& found) {
  std::vector<const FoundMuscle*> heads;
  for (const FoundMuscle& each : found.muscles)
    if (is_called_a_head_of(each, whole)) heads.push_back(&each);
  if (heads.size() < 2) return {};
  const SignedDistance around(whole.mesh);
  std::vector<std::string> names;
  for (const FoundMuscle* head : heads)
    if (share_within(head->mesh, around, about_on_it * found.size, 100) >= most_of_it) names.push_back(head->name);
  return names;
}

}  // namespace

/// Whether its heads begin or end on segments that move against each other.
static bool has_heads_that_move_apart(const FoundMuscle& whole) {
  if (!whole.known || !whole.mended || whole.mended->heads.size() < 2) return false;
  const auto differ = [](const std::vector<Site>& sites) {
    return std::any_of(sites.begin(), sites.end(),
                       [&](const Site& site) { return segment_of(site) != segment_of(sites.front()); });
  };
  return differ(whole.known->origin) || differ(whole.known->insertion);
}

/// Each of its heads as a muscle, called by its number; none where a run would refuse one.
static std::vector<FoundMuscle> heads_as_muscles(const FoundMuscle& whole) try {
  const std::string side = side_ending(whole.side);
  const std::string stem = whole.name.substr(0, whole.name.size() - (whole.name.ends_with(side) ? side.size() : 0));
  std::vector<FoundMuscle> heads;
  for (const TriangleMesh& mesh : whole.mended->heads) {
    FoundMuscle& head = heads.emplace_back(whole);
    head.name = fmt::format("{}_{}{}", stem, heads.size(), side);
    head.mesh = check_surface(mesh, 1, SurfaceRole::muscle, head.name).mesh;
    head.mended->heads.clear();
    head.mended->repairs = {fmt::format("one of {} pieces that cut each other", whole.mended->heads.size())};
  }
  return heads;
} catch (const InputError&) {
  return {};
}

void take_heads_apart(FoundFolder& found) {
  std::set<std::string> names;
  for (const FoundMuscle& muscle : found.muscles) names.insert(muscle.name);
  std::vector<FoundMuscle> muscles;
  for (FoundMuscle& muscle : found.muscles) {
    std::vector<FoundMuscle> heads;
    if (has_heads_that_move_apart(muscle)) heads = heads_as_muscles(muscle);
    const auto is_taken = [&](const FoundMuscle& head) { return names.contains(head.name); };
    if (heads.empty() || std::any_of(heads.begin(), heads.end(), is_taken)) heads = {std::move(muscle)};
    for (FoundMuscle& head : heads) muscles.push_back(std::move(head));
  }
  found.muscles = std::move(muscles);
}

void leave_out_wholes(FoundFolder& found) {
  std::vector<std::string> wholes;
  for (const FoundMuscle& muscle : found.muscles) {
    const std::vector<std::string> heads = heads_of(muscle, found);
    if (heads.size() < 2) continue;
    wholes.push_back(muscle.name);
    found.left_out.push_back(fmt::format("{}: its heads are here, too: {}; remove them to have it in one piece",
                                         muscle.file.string(), fmt::join(heads, ", ")));
  }
  std::erase_if(found.muscles, [&](const FoundMuscle& muscle) {
    return std::find(wholes.begin(), wholes.end(), muscle.name) != wholes.end();
  });
}

}  // namespace gracilis
