#include <gracilis/draft/muscle_heads.hpp>

#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/winding_number.hpp>

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

bool lies_in(const TriangleMesh& head, const NearestTriangle& surface, const WindingNumber& inside, Real reach) {
  const Index step = 1 + head.vertex_count() / 100;
  Index within = 0, count = 0;
  for (Index v = 0; v < head.vertex_count(); v += step, ++count) {
    const Vec3 p = head.vertices.col(v);
    within += surface.query(p).distance < reach || inside.query(p) > 0.5;
  }
  return static_cast<Real>(within) >= most_of_it * static_cast<Real>(count);
}

std::vector<std::string> heads_of(const FoundMuscle& whole, const FoundFolder& found) {
  std::vector<const FoundMuscle*> heads;
  for (const FoundMuscle& each : found.muscles)
    if (is_called_a_head_of(each, whole)) heads.push_back(&each);
  if (heads.size() < 2) return {};
  const NearestTriangle surface(whole.mesh);
  const WindingNumber inside(whole.mesh);
  std::vector<std::string> names;
  for (const FoundMuscle* head : heads)
    if (lies_in(head->mesh, surface, inside, about_on_it * found.size)) names.push_back(head->name);
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
