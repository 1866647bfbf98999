#pragma once

#include <gracilis/core/parallel.hpp>
#include <gracilis/methods/tissue/ends_on_muscles.hpp>
#include <gracilis/methods/tissue/factored_matrix.hpp>
#include <gracilis/methods/tissue/minimize.hpp>
#include <gracilis/methods/tissue/total_energy.hpp>

#include <chrono>
#include <vector>

namespace gracilis::tissue {

/// The muscles of a scene and what they do to each other; constant but for what `neighbors` keeps.
struct TissueMuscles {
  std::vector<PreparedTissue> muscles;
  std::vector<EndOnMuscle> ends;
  std::vector<std::vector<std::size_t>> groups_joined;  ///< of muscles, by ends
  std::vector<char> is_joined;                          ///< per muscle: whether it is in such a group
  Neighbors neighbors;                                  ///< without pairs where muscles do not meet
  int rounds = 0;                                       ///< of looking at neighbors, in each step
};

/// `fields` and `distances` have one entry per bone; fields must outlive the result. Precondition: the scene is valid.
TissueMuscles prepare_tissues(const Scene& scene, const std::vector<DistanceField>& fields,
                              const std::vector<SignedDistance>& distances);

/// What the nodes of a muscle are in equilibrium with.
struct Equilibrium {
  std::vector<CellLaw> laws;
  Surroundings around;
  Real next_pressure = 0;  ///< Pa, of LawLanes, that would keep the muscle's volume: for when it settles next
};

/// A muscle on its way to a pose.
struct MovingMuscle {
  Points nodes;
  Points seen;              ///< its surface in the end
  Real active_tension = 0;  ///< Pa, of its fibers
  Equilibrium equilibrium;
  std::vector<RigidTransform> bodies;  ///< where they were in the last step
  const FactoredMatrix* metric = nullptr;
  Minimized done;
  int iterations = 0;
  Real milliseconds = 0;
};

/// Calls act() and adds the time that it took to the muscle's.
template <class Act>
void timed(MovingMuscle& moving, const Act& act) {
  const Real before = moving.milliseconds;
  const auto started = std::chrono::steady_clock::now();
  act();
  const std::chrono::duration<Real, std::milli> taken = std::chrono::steady_clock::now() - started;
  moving.milliseconds = before + taken.count();
}

/// Calls act(m) for each muscle, side by side, timed.
template <class Act>
void for_each_timed(std::vector<MovingMuscle>& moving, const Act& act) {
  parallel_for_each(moving.size(), [&](std::size_t m) { timed(moving[m], [&] { act(m); }); });
}

/// Throws QualityError.
void require_finite(const PreparedTissue& muscle, bool is_finite);

/// Takes all muscles to rest among each other, in rounds of looking at neighbors and settling. `expected_move` (m): how
/// far nodes are thought to move in a round, which is how far muscles look; where one moves further the round is done
/// again, looking as far as ever. Returns what to expect the next time.
Real settle_muscles(TissueMuscles& tissues, Real expected_move, std::vector<MovingMuscle>& moving);

}  // namespace gracilis::tissue
