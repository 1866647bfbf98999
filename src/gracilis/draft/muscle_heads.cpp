#include <gracilis/draft/muscle_heads.hpp>

#include <gracilis/geometry/signed_distance.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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
