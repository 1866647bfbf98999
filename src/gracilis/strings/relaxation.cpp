#include <gracilis/strings/relaxation.hpp>

#include <gracilis/geometry/rigid_blend.hpp>
#include <gracilis/strings/lane_relaxation.hpp>
#include <gracilis/strings/node_relaxation.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gracilis::strings {

namespace {

/// In double precision strings settle until no node moves further, m.
constexpr Real settled_move = 1e-7;

/// The largest turn of a body from one pose to another, rad.
Real largest_turn(const std::vector<RigidTransform>& before, const std::vector<RigidTransform>& now) {
  Real turn = 0;
  for (std::size_t b = 0; b < now.size(); ++b)
    turn = std::max(turn, Eigen::AngleAxisd(before[b].linear().transpose() * now[b].linear()).angle());
  return turn;
}

/// The bodies a share of the way from one pose to another, each on its screw.
std::vector<RigidTransform> bodies_between(const std::vector<RigidTransform>& before,
                                           const std::vector<RigidTransform>& now, Real share) {
  std::vector<RigidTransform> between;
  for (std::size_t b = 0; b < now.size(); ++b)
    between.push_back(blend(prepare_blend(std::array{before[b], now[b]}), std::array{1 - share, share}));
  return between;
}

}  // namespace

Points pulled_tight(const MuscleStrings& muscle, const BoneDistances& bones) {
  MuscleStrings bare = muscle;
  bare.taut = muscle.fibers;
  bare.ties.setZero();
  for (std::vector<Index>& neighbors : bare.neighbors) neighbors.clear();
  Points places = muscle.fibers;
  const std::vector<RigidTransform> bodies(static_cast<std::size_t>(muscle.shares.rows()), RigidTransform::Identity());
  NodeForces forces(bare, bones, bodies);
  relax_nodes(forces, {muscle.settings.rest_iterations, muscle.settings.rest_stop_move}, places);
  return places;
}

/// Which strings still moved.
template <class Moves>
static std::vector<char> unsettled(const Moves& moves) {
  std::vector<char> strings;
  for (const auto move : moves) strings.push_back(!(static_cast<Real>(move) < unsettled_move));
  return strings;
}

std::vector<char> settle_nearly(const MuscleStrings& muscle, const BoneDistances& bones, StringState& state) {
  LanePlaces places = lane_places(muscle.lanes, state.places);
  const std::vector<float> moves = relax_lanes(muscle, bones, state.bodies, settling_nearly, places);
  state.places = places_of(muscle.lanes, places);
  return unsettled(moves);
}

std::vector<char> settle(const MuscleStrings& muscle, const BoneDistances& bones, StringState& state) {
  settle_nearly(muscle, bones, state);
  NodeForces forces(muscle, bones, state.bodies);
  Relaxation settling = settling_nearly;
  settling.stop_move = settled_move;
  return unsettled(relax_nodes(forces, settling, state.places));
}

StringState capture_state(const MuscleStrings& muscle, std::size_t bodies) {
  return {muscle.taut, std::vector<RigidTransform>(bodies, RigidTransform::Identity())};
}

void follow(const MuscleStrings& muscle, const BoneDistances& bones, const Pose& pose, StringState& state) {
  const Real turn = largest_turn(state.bodies, pose.bodies);
  constexpr Real rounding = 1e-6;
  const int steps = std::max(1, static_cast<int>(std::ceil(turn / muscle.settings.step_turn - rounding)));
  const std::vector<RigidTransform> begun = state.bodies;
  const Relaxation relaxation{muscle.settings.iterations, muscle.settings.stop_move};
  LanePlaces places = lane_places(muscle.lanes, state.places);
  for (int step = 1; step <= steps; ++step) {
    const std::vector<RigidTransform> bodies =
        step == steps ? pose.bodies : bodies_between(begun, pose.bodies, static_cast<Real>(step) / steps);
    carry_lanes(muscle.lanes, state.bodies, bodies, places);
    relax_lanes(muscle, bones, bodies, relaxation, places);
    state.bodies = bodies;
  }
  state.places = places_of(muscle.lanes, places);
}

}  // namespace gracilis::strings
