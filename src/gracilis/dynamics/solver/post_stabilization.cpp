#include <gracilis/dynamics/solver/post_stabilization.hpp>

#include <gracilis/dynamics/solver/bone_contact.hpp>
#include <gracilis/dynamics/solver/constraint_table.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

/// Passes over edges beyond the strain limit before contact and volume settle.
constexpr int limit_passes = 10;
/// Rounds in which a surface goes on settling while its volume is off by more than this share.
constexpr int further_rounds = 16;
constexpr double squeezed = 1e-3;
/// Passes in which surfaces recover that in the end are squeezed so far, or torn: with an edge so many times as long as
/// the limit allows.
constexpr int recovering_passes = 40;
constexpr float torn = 1.1f;
/// Rounds of repair, and passes after each in which what was moved gets its volume and keeps out of bones.
constexpr int repair_rounds = 3, passes_after_repair = 2;

/// Whether contact has squeezed it out of its volume.
bool is_squeezed(const SurfaceSolve& surface) {
  const VolumeSet& volume = surface.system->volume;
  if (volume.compliance > 0 || volume.group_count() == 0 || surface.settings.settling_rounds <= 0) return false;
  const double target = surface.settings.pressure * volume.target;
  SurfaceState& state = *surface.state;
  return std::abs(enclosed_volume(volume, state.volume_gradients, state.particles) - target) > squeezed * target;
}

/// Whether an edge is longer than the limit allows by more than single passes leave.
bool is_torn(const SurfaceSolve& surface) {
  const float limit = surface.settings.strain_limit;
  if (!(limit > 0) || surface.settings.settling_rounds <= 0) return false;
  const DistanceSet& edges = surface.system->distances;
  const Particles& particles = surface.state->particles;
  for (std::size_t slot = 0; slot < edges.a.size(); ++slot) {
    const float longest = torn * limit * edges.rest_length[slot];
    if (!((particles.position(edges.b[slot]) - particles.position(edges.a[slot])).squaredNorm() > longest * longest))
      continue;
    if (particles.inverse_mass(edges.a[slot]) + particles.inverse_mass(edges.b[slot]) > 0) return true;
  }
  return false;
}

/// Leaves those movers of which `is_wanted` holds; false when there are none.
template <class Wanted>
bool keep_movers(JointSolve& solve, const Wanted& is_wanted) {
  std::vector<char> kept(solve.surfaces.size(), 0);
  parallel_for_each(kept.size(),
                    [&](std::size_t i) { kept[i] = solve.movers.move(i) && is_wanted(solve.surfaces[i]); });
  solve.movers.listed = std::move(kept);
  return std::any_of(solve.movers.listed.begin(), solve.movers.listed.end(), [](char each) { return each != 0; });
}

/// The movers that ask for more rounds than this many.
auto movers_of_round(const JointSolve& solve, int round) {
  return [&solve, round](std::size_t i) {
    return solve.movers.move(i) && round < solve.surfaces[i].settings.settling_rounds;
  };
}

auto all_movers(const JointSolve& solve) {
  return [&solve](std::size_t i) { return solve.movers.move(i); };
}

template <class Wanted>
void project(ConstraintKind kind, JointSolve& solve, const Wanted& is_wanted) {
  solve.for_each(is_wanted, [&](std::size_t i) {
    SurfaceSolve& surface = solve.surfaces[i];
    const Index touching = surface.report.contacts;
    project_kind(kind, surface);
    // Where settling leaves nothing to push, what was pushed before still touches.
    surface.report.contacts = std::max(surface.report.contacts, touching);
    solve.tell(i, kind);
  });
}

/// The strain limit and what comes after contact between surfaces.
template <class Wanted>
void pull_together(JointSolve& solve, const Wanted& is_wanted) {
  project(ConstraintKind::strain_limit, solve, is_wanted);
  project(ConstraintKind::shape_limit, solve, is_wanted);
  solve.for_each(is_wanted, [&](std::size_t i) {
    const SurfaceSolve& surface = solve.surfaces[i];
    keep_listed(*surface.system, *surface.placements, *surface.state);
  });
  for (const ConstraintRow& row : constraint_table())
    if (row.phase == ConstraintPhase::after_contact) project(row.kind, solve, is_wanted);
}

template <class Wanted>
void settle_once(JointSolve& solve, const Wanted& is_wanted) {
  project(ConstraintKind::volume, solve, is_wanted);
  solve.project_contact();
  pull_together(solve, is_wanted);
}

/// From this share of the way to a limit of shape on, a particle may come to it while its surface settles.
constexpr float near_limit = 0.7f;

void list_near_shape_limits(const SurfaceSolve& surface) {
  const ShapeLimits& limits = surface.settings.shape_limits;
  SurfaceState& state = *surface.state;
  state.near_shape_limit.clear();
  if (limits.any())
    state.near_shape_limit = near_shape_limits(surface.system->shape_limits, limits, near_limit, state.particles);
}

/// What was moved may be near any bone and may be stretched far.
void list_anew(JointSolve& solve) {
  solve.for_each(movers_of_round(solve, 0), [&](std::size_t i) {
    const SurfaceSolve& surface = solve.surfaces[i];
    keep_listed(*surface.system, *surface.placements, *surface.state);
    find_edge_points(*surface.system, *surface.placements, *surface.state);
    activate_all(surface.state->strained);
    list_near_shape_limits(surface);
  });
}

/// What was moved since the last iteration, by untangling too, may be near anything.
void look_again(JointSolve& solve) {
  if (solve.coupling.refresh) solve.coupling.refresh(solve.movers);
  list_anew(solve);
}

/// Goes on with those that are still squeezed.
void settle_squeezed(JointSolve& solve) {
  const Movers settled = solve.movers;
  for (int round = 0; round < further_rounds && keep_movers(solve, is_squeezed); ++round)
    settle_once(solve, all_movers(solve));
  solve.movers = settled;
}

}  // namespace

void settle(JointSolve& solve) {
  int rounds = 0;
  for (const SurfaceSolve& surface : solve.surfaces) rounds = std::max(rounds, surface.settings.settling_rounds);
  look_again(solve);
  // What untangling took to its place may have stretched edges far, and what contact does in each round some.
  for (int pass = 0; pass < limit_passes; ++pass) {
    project(ConstraintKind::strain_limit, solve, movers_of_round(solve, 0));
    project(ConstraintKind::shape_limit, solve, movers_of_round(solve, 0));
  }
  for (int round = 0; round < rounds; ++round) settle_once(solve, movers_of_round(solve, round));
  settle_squeezed(solve);
}

void recover(JointSolve& solve) {
  solve.movers = {};
  const auto is_hurt = [](const SurfaceSolve& surface) { return is_torn(surface) || is_squeezed(surface); };
  for (int pass = 0; pass < recovering_passes && keep_movers(solve, is_hurt); ++pass) {
    project(ConstraintKind::volume, solve, all_movers(solve));
    pull_together(solve, all_movers(solve));
  }
}

void repair(JointSolve& solve) {
  if (!solve.coupling.repair_penetrations) return;
  for (int round = 0; round < repair_rounds; ++round) {
    solve.movers = {};
    solve.coupling.refresh(solve.movers);
    solve.movers.listed = solve.coupling.repair_penetrations();
    if (solve.movers.listed.empty()) return;
    list_anew(solve);
    for (int pass = 0; pass < passes_after_repair; ++pass) {
      project(ConstraintKind::volume, solve, all_movers(solve));
      pull_together(solve, all_movers(solve));
    }
  }
}

}  // namespace gracilis
