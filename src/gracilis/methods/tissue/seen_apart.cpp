#include <gracilis/methods/tissue/seen_apart.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/tissue/out_of_bones.hpp>
#include <gracilis/methods/tissue/seen_surface.hpp>

namespace gracilis::tissue {

/// What comes out of one muscle may come into another, or back by what its volume asks for.
static constexpr int apart_rounds = 3;

void keep_seen_apart(TissueMuscles& tissues, const std::vector<SignedDistance>& distances, Real moved,
                     std::vector<MovingMuscle>& moving) {
  std::vector<Points> seen;
  for (MovingMuscle& each : moving) seen.push_back(std::move(each.seen));
  for (int round = 0; round < apart_rounds; ++round) {
    const std::vector<Points> ways = ways_apart(tissues.neighbors, seen, moved);
    bool any = false;
    for (const Points& way : ways) any = any || way.cols() > 0;
    if (!any) break;
    parallel_for_each(moving.size(), [&](std::size_t m) {
      if (ways[m].cols() == 0) return;
      timed(moving[m], [&] {
        const Real volume = enclosed_volume(seen[m], tissues.muscles[m].faces);
        seen[m] += ways[m];
        meet_volume(tissues.muscles[m], volume, seen[m]);
        push_out_of_bones(tissues.muscles[m], moving[m].equilibrium.around, distances, seen[m]);
      });
    });
  }
  for (std::size_t m = 0; m < moving.size(); ++m) moving[m].seen = std::move(seen[m]);
}

}  // namespace gracilis::tissue
