#include <gracilis/strings/relaxation.hpp>

#include <gracilis/geometry/rigid_blend.hpp>
#include <gracilis/strings/node_forces.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gracilis::strings {

namespace {

/// After so many iterations steps are damped, for strings that go to and fro between two bones.
constexpr int undamped_iterations = 12;
constexpr Real damping = 0.6;
/// Strings settle until no node moves further, m, or for so many iterations; the last ones take small steps, which end
/// most going to and fro.
constexpr Real settled_move = 1e-7;
constexpr int settling_iterations = 300, settling_quenched_from = 80;
constexpr Real quenching = 0.25;
/// One that would still move further than this then, m, has no place; less matters nothing to its derivative.
constexpr Real unsettled_move = 5e-6;

/// One step of Gauss-Newton for one string, of which a share is taken; how far a node would move, m.
Real relax_string(NodeForces& forces, Index string, Real taken, Points& places, StringSystem& system) {
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

/// A string of which no node moved further than `stop_move` rests from then on; most are soon where they stay. After
/// `quenched_from` iterations steps are small. Returns how far a node of each string moved last, m.
std::vector<Real> relax(NodeForces& forces, int iterations, Real stop_move, Points& places,
                        int quenched_from = std::numeric_limits<int>::max()) {
  const MuscleStrings& muscle = forces.muscle();
  StringSystem system(muscle.nodes);
  std::vector<Real> moved(static_cast<std::size_t>(muscle.strings), std::numeric_limits<Real>::infinity());
  const auto rests = [&](Real move) { return move < stop_move; };
  for (int iteration = 0; iteration < iterations; ++iteration) {
    forces.begin_iteration(places);
    const Real taken = iteration > quenched_from ? quenching : iteration > undamped_iterations ? damping : 1;
    for (Index s = 0; s < muscle.strings; ++s) {
      Real& move = moved[static_cast<std::size_t>(s)];
      if (!rests(move)) move = relax_string(forces, s, taken, places, system);
    }
    if (std::all_of(moved.begin(), moved.end(), rests)) break;
  }
  return moved;
}

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

/// Where bodies carry the nodes that another pose left; held ones go with their bodies.
void carry(const MuscleStrings& muscle, const std::vector<RigidTransform>& before,
           const std::vector<RigidTransform>& now, Points& places) {
  std::vector<RigidTransform> motions;
  for (std::size_t b = 0; b < now.size(); ++b) motions.push_back(now[b] * before[b].inverse());
  for (Index s = 0; s < muscle.strings; ++s)
    for (Index i = 0; i < muscle.nodes; ++i) {
      const Index p = muscle.node(s, i);
      if (const Index body = body_holding(muscle, s, i); body >= 0) {
        places.col(p) = now[static_cast<std::size_t>(body)] * Vec3(muscle.taut.col(p));
        continue;
      }
      Vec3 carried = Vec3::Zero();
      for (Index b = 0; b < muscle.shares.rows(); ++b)
        if (muscle.shares(b, p) > 0)
          carried += muscle.shares(b, p) * (motions[static_cast<std::size_t>(b)] * Vec3(places.col(p)));
      places.col(p) = carried;
    }
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
  relax(forces, muscle.settings.rest_iterations, muscle.settings.rest_stop_move, places);
  return places;
}

std::vector<char> settle(const MuscleStrings& muscle, const BoneDistances& bones, StringState& state) {
  NodeForces forces(muscle, bones, state.bodies);
  std::vector<char> unsettled;
  for (const Real move : relax(forces, settling_iterations, settled_move, state.places, settling_quenched_from))
    unsettled.push_back(!(move < unsettled_move));
  return unsettled;
}

StringState capture_state(const MuscleStrings& muscle, std::size_t bodies) {
  return {muscle.taut, std::vector<RigidTransform>(bodies, RigidTransform::Identity())};
}

void follow(const MuscleStrings& muscle, const BoneDistances& bones, const Pose& pose, StringState& state) {
  const Real turn = largest_turn(state.bodies, pose.bodies);
  constexpr Real rounding = 1e-6;
  const int steps = std::max(1, static_cast<int>(std::ceil(turn / muscle.settings.step_turn - rounding)));
  const std::vector<RigidTransform> begun = state.bodies;
  for (int step = 1; step <= steps; ++step) {
    const std::vector<RigidTransform> bodies =
        step == steps ? pose.bodies : bodies_between(begun, pose.bodies, static_cast<Real>(step) / steps);
    carry(muscle, state.bodies, bodies, state.places);
    NodeForces forces(muscle, bones, bodies);
    relax(forces, muscle.settings.iterations, muscle.settings.stop_move, state.places);
    state.bodies = bodies;
  }
}

}  // namespace gracilis::strings
