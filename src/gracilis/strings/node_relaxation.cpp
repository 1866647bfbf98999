#include <gracilis/strings/node_relaxation.hpp>

#include <algorithm>
#include <limits>

namespace gracilis::strings {

/// One step of Gauss-Newton for one string, of which a share is taken; how far a node would move, m.
static Real relax_string(NodeForces& forces, Index string, Real taken, Points& places, StringSystem& system) {
  const MuscleStrings& muscle = forces.muscle();
  forces.assemble(string, places, system);
  system.solve();
  const StringSettings& settings = muscle.settings;
  Real farthest = 0;
  for (Index i = 1; i + 1 < muscle.nodes; ++i) {
    const Vec3& move = system.solution[static_cast<std::size_t>(i)];
    const Real length = move.norm();
    farthest = std::max(farthest, length);
    const Real share = length > settings.longest_move ? settings.longest_move / length : 1;
    places.col(muscle.node(string, i)) += taken * share * move;
  }
  forces.string_moved(string, std::min(farthest, settings.longest_move));
  return farthest;
}

std::vector<Real> relax_nodes(NodeForces& forces, const Relaxation& relaxation, Points& places) {
  const MuscleStrings& muscle = forces.muscle();
  StringSystem system(muscle.nodes);
  std::vector<Real> moved(static_cast<std::size_t>(muscle.strings), std::numeric_limits<Real>::infinity());
  const auto rests = [&](Real move) { return move < relaxation.stop_move; };
  for (int iteration = 0; iteration < relaxation.iterations; ++iteration) {
    forces.begin_iteration(places);
    const Real taken = taken_share(relaxation, iteration);
    for (Index s = 0; s < muscle.strings; ++s) {
      Real& move = moved[static_cast<std::size_t>(s)];
      if (!rests(move)) move = relax_string(forces, s, taken, places, system);
    }
    if (std::all_of(moved.begin(), moved.end(), rests)) break;
  }
  return moved;
}

}  // namespace gracilis::strings
