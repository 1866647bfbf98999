#include <gracilis/dynamics/solver/solver.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/field/field_contact_away.hpp>
#include <gracilis/dynamics/particle_order.hpp>

#include <hwy/cache_control.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

namespace gracilis {

namespace {

/// Slots per task: large enough to outweigh a task's start, small enough to share a color among cores.
constexpr Index slots_per_task = 1024;
/// How near to the bones counts as near (m), and iterations between two looks at whether particles moved so far that
/// something may have come near.
constexpr float contact_reach = 0.006f;
constexpr int motion_check = 4;
/// Iterations between two looks at what is near between surfaces, which walk and list with reserve.
constexpr int coupling_refresh = 15;
/// Passes over edges beyond the limit of stretch before contact and volume settle.
constexpr int limit_passes = 10;
/// Rounds in which a surface goes on settling while its volume is off by more than this share.
constexpr int further_rounds = 16;
constexpr double squeezed = 1e-3;
/// Passes in which surfaces recover that in the end are squeezed so far, or torn: with an edge so many times as long as
/// the limit allows.
constexpr int recovering_passes = 10;
constexpr float torn = 1.1f;
/// Most attempts at mending what cannot stay; what is crushed may resist them all.
constexpr int mending_attempts = 4;

/// Has the positions of particles brought near before constraints ask for them in an order that no machine foresees.
void fetch(const Particles& particles, Index begin, Index end) {
  constexpr Index particles_per_line = 4;
  for (Index p = begin; p < end; p += particles_per_line) hwy::Prefetch(particles.at(p));
}

/// Calls project(range) for all slots: clusters side by side, then what lies across them, one color after the other.
template <class Project>
void for_each_color(const ColorOrder& order, const Particles& particles, const Project& project) {
  const Index clusters = order.cluster_count();
  parallel_for(clusters, 1, [&](Index begin, Index end) {
    for (Index cluster = begin; cluster < end; ++cluster) {
      fetch(particles, begin_of_cluster(cluster, particles.count(), clusters),
            begin_of_cluster(cluster + 1, particles.count(), clusters));
      for (Index color = order.clusters[static_cast<std::size_t>(cluster)];
           color < order.clusters[static_cast<std::size_t>(cluster) + 1]; ++color)
        project(order.colors[static_cast<std::size_t>(color)]);
    }
  });
  for (auto i = static_cast<std::size_t>(order.clusters.back()); i < order.colors.size(); ++i) {
    const ColorRange color = order.colors[i];
    parallel_for(color.end - color.begin, slots_per_task, [&](Index begin, Index end) {
      project(ColorRange{color.begin + begin, color.begin + end});
    });
  }
}

template <class Project>
void project_colors(const ColorOrder& order, const Particles& particles, SolveReport& report, const Project& project) {
  std::atomic<Index> limited = 0, skipped = 0;
  for_each_color(order, particles, [&](ColorRange range) {
    const ProjectionCounts counts = project(range);
    limited += counts.limited;
    skipped += counts.skipped;
  });
  report.limited_hinges += limited;
  report.skipped_constraints += skipped;
}

void project_contacts(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements, SurfaceState& state,
                      SolveReport& report) {
  report.contacts = 0;
  for (std::size_t i = 0; i < system.contacts.size(); ++i)
    report.contacts += project_edge_contacts(system.contacts[i], placements[i], state.near[i], state.particles);
  for (std::size_t i = 0; i < system.contacts.size(); ++i)
    report.contacts += project_middle_contacts(system.contacts[i], placements[i], state.near[i], state.particles);
  for (std::size_t i = 0; i < system.contacts.size(); ++i)
    report.contacts +=
        project_face_contacts(system.contacts[i], system.large_faces, placements[i], state.near[i], state.particles);
  for (std::size_t i = 0; i < system.contacts.size(); ++i)
    report.contacts += project_particle_contacts(system.contacts[i], placements[i], state.near[i], state.particles);
  project_squeezed(system.contacts, placements, state.near, state.particles);
}

/// The watch on the limit of stretch, begun if need be; none where there is no limit.
StretchWatch* stretch_watch(const SurfaceSystem& system, const SolveSettings& settings, SurfaceState& state) {
  if (!(settings.stretch_limit > 0)) return nullptr;
  watch_stretch(system.distances, settings.stretch_limit, state.stretched);
  return &state.stretched;
}

void limit_edges(const SurfaceSystem& system, const StretchWatch& watch, SurfaceState& state, SolveReport& report) {
  std::atomic<Index> limited = 0;
  for_each_color(system.distances.order, state.particles, [&](ColorRange range) {
    limited += limit_stretch(system.distances, range, watch.limit, state.particles, &watch);
  });
  report.limited_edges += limited;
}

}  // namespace

const char* name_of(ConstraintKind kind) {
  switch (kind) {
    case ConstraintKind::none:
      return "none";
    case ConstraintKind::distance:
      return "distance";
    case ConstraintKind::contraction:
      return "contraction";
    case ConstraintKind::dihedral:
      return "dihedral";
    case ConstraintKind::volume:
      return "volume";
    case ConstraintKind::stretch_limit:
      return "stretch limit";
    case ConstraintKind::muscle_contact:
      return "muscle contact";
    case ConstraintKind::slivers:
      return "sliver";
    case ConstraintKind::tight_places:
      return "tight place";
    case ConstraintKind::bone_contact:
      return "bone contact";
  }
  return "?";
}

SurfaceState make_state(const SurfaceSystem& system) {
  SurfaceState state;
  state.particles = system.rest;
  state.start = system.rest;
  state.velocities.assign(3 * static_cast<std::size_t>(system.rest.count()), 0);
  state.target_length = system.distances.rest_length;
  state.contraction_length = system.contractions.rest_length;
  state.distance_lambda.assign(system.distances.a.size(), 0);
  state.contraction_lambda.assign(system.contractions.a.size(), 0);
  state.hinge_lambda.assign(system.hinges.rest_angle.size(), 0);
  state.volume = system.volume.target;
  state.near.resize(system.contacts.size());
  return state;
}

void project_kind(ConstraintKind kind, const SurfaceSystem& system, const std::vector<FieldPlacement>& placements,
                  const SolveSettings& settings, SurfaceState& state, SolveReport& report) {
  switch (kind) {
    case ConstraintKind::none:
    case ConstraintKind::muscle_contact:  // is no one surface's
      break;
    case ConstraintKind::distance: {
      StretchWatch* const watch = stretch_watch(system, settings, state);
      if (watch) look_nowhere(*watch);
      project_colors(system.distances.order, state.particles, report, [&](ColorRange range) {
        return project_distances(system.distances, range, state.target_length.data(), state.distance_lambda.data(),
                                 state.start, state.particles, settings.projection, watch);
      });
      break;
    }
    case ConstraintKind::contraction:
      if (!(settings.contraction > 0)) break;
      project_colors(system.contractions.order, state.particles, report, [&](ColorRange range) {
        return project_contractions(system.contractions, range, state.contraction_length.data(), settings.contraction,
                                    state.contraction_lambda.data(), state.particles, settings.projection);
      });
      break;
    case ConstraintKind::dihedral:
      project_colors(system.hinges.order, state.particles, report, [&](ColorRange range) {
        return project_hinges(system.hinges, range, state.hinge_lambda.data(), state.start, state.particles,
                              settings.projection);
      });
      break;
    case ConstraintKind::volume:
      state.volume = project_volume(system.volume, settings.time_step, settings.pressure, state.volume_lambda,
                                    state.volume_gradients, state.particles);
      break;
    case ConstraintKind::stretch_limit:
      if (const StretchWatch* watch = stretch_watch(system, settings, state))
        limit_edges(system, *watch, state, report);
      break;
    case ConstraintKind::slivers:
      project_slivers(system.slivers, state.particles);
      break;
    case ConstraintKind::tight_places:
      project_tight_places(system.tight_places, state.particles);
      break;
    case ConstraintKind::bone_contact:
      project_contacts(system, placements, state, report);
      break;
  }
}

void refresh_contacts(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements, SurfaceState& state) {
  const SurfaceMotion motion = surface_motion(state.listed, state.particles);
  const float reach = listing_reach(system.distances, contact_reach);
  for (std::size_t i = 0; i < system.contacts.size(); ++i) {
    NearField& near = state.near[i];
    near.away.distance = away_after(motion, placements[i], near.away);
    near.away.placement = placements[i];
    if (near.away.distance - near.away.largest_gap > reach && system.contacts[i].ceiling.empty())
      clear_near(near);
    else
      find_near(system.contacts[i], system.distances, system.large_faces, placements[i], contact_reach, state.particles,
                near);
  }
  state.listed = state.particles;
}

void remember_sides(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements, SurfaceState& state) {
  const SurfaceMotion motion = surface_motion(state.listed, state.particles);
  for (std::size_t i = 0; i < system.contacts.size(); ++i)
    if (!(away_after(motion, placements[i], state.near[i].away) > far_away))
      remember_sides(system.contacts[i], placements[i], state.particles, state.near[i]);
}

namespace {

void find_edge_points(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements, SurfaceState& state) {
  for (std::size_t i = 0; i < system.contacts.size(); ++i)
    find_edge_points(system.contacts[i], placements[i], state.particles, state.near[i]);
}

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Where one surface stands in its iterations.
struct Progress {
  bool last = false, done = false;
  Particles before;
};

void reset_multipliers(SurfaceState& state) {
  std::fill(state.distance_lambda.begin(), state.distance_lambda.end(), 0.0f);
  std::fill(state.contraction_lambda.begin(), state.contraction_lambda.end(), 0.0f);
  std::fill(state.hinge_lambda.begin(), state.hinge_lambda.end(), 0.0f);
  state.volume_lambda = 0;
}

/// Lists what is near the bones again where something that is not listed may have come near.
void keep_listed(const SurfaceSolve& surface) {
  if (largest_motion(surface.state->listed, surface.state->particles) > listed_motion)
    refresh_contacts(*surface.system, *surface.placements, *surface.state);
}

/// All of an iteration up to contact between surfaces.
void begin_iteration(SurfaceSolve& surface, Progress& progress, double elapsed,
                     const std::function<void(ConstraintKind)>& told) {
  const SolveSettings& settings = surface.settings;
  const int iteration = surface.report.iterations;
  if (settings.stop_displacement > 0) progress.before = surface.state->particles;
  progress.last =
      iteration + 1 >= settings.iterations || (settings.stop_milliseconds > 0 && elapsed > settings.stop_milliseconds);
  if (iteration == 0)
    refresh_contacts(*surface.system, *surface.placements, *surface.state);
  else if (iteration % motion_check == 0)
    keep_listed(surface);
  for (ConstraintKind kind : kinds_before_contact) {
    project_kind(kind, *surface.system, *surface.placements, settings, *surface.state, surface.report);
    told(kind);
  }
}

void end_iteration(SurfaceSolve& surface, Progress& progress, const std::function<void(ConstraintKind)>& told) {
  const SolveSettings& settings = surface.settings;
  if (progress.last) keep_listed(surface);
  for (ConstraintKind kind : kinds_after_contact) {
    project_kind(kind, *surface.system, *surface.placements, settings, *surface.state, surface.report);
    told(kind);
  }
  ++surface.report.iterations;
  progress.done =
      progress.last || (settings.stop_displacement > 0 &&
                        largest_motion(progress.before, surface.state->particles) < settings.stop_displacement);
}

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
  const float limit = surface.settings.stretch_limit;
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
bool keep_movers(const std::vector<SurfaceSolve>& surfaces, const Wanted& is_wanted, Movers& movers) {
  std::vector<char> kept(surfaces.size(), 0);
  parallel_for_each(surfaces.size(), [&](std::size_t i) { kept[i] = movers.move(i) && is_wanted(surfaces[i]); });
  movers.listed = std::move(kept);
  return std::any_of(movers.listed.begin(), movers.listed.end(), [](char each) { return each != 0; });
}

}  // namespace

void solve_together(std::vector<SurfaceSolve>& surfaces, const Coupling& coupling, const SolveWatch& watch) {
  const Clock::time_point begin = Clock::now();
  std::vector<Progress> progress(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    reset_multipliers(*surfaces[i].state);
    surfaces[i].report = {};
    progress[i].done = surfaces[i].settings.iterations <= 0;
  }
  const auto for_each = [&](const auto& wanted, const auto& act) {
    parallel_for_each(surfaces.size(), [&](std::size_t i) {
      if (!wanted(i)) return;
      const Clock::time_point started = Clock::now();
      act(surfaces[i], progress[i], [&, i](ConstraintKind kind) {
        if (watch) watch(i, kind);
      });
      surfaces[i].report.milliseconds += milliseconds_since(started);
    });
  };
  Movers movers;
  const auto couple = [&] {
    if (!coupling.project) return;
    const Clock::time_point started = Clock::now();
    coupling.project(movers);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      if (watch) watch(i, ConstraintKind::muscle_contact);
      surfaces[i].report.milliseconds += milliseconds_since(started) / static_cast<double>(surfaces.size());
    }
  };
  const auto is_active = [&](std::size_t i) { return !progress[i].done; };
  const auto is_done = [](const Progress& each) { return each.done; };
  for (int iteration = 0;; ++iteration) {
    const double elapsed = milliseconds_since(begin);
    // The end of one iteration and the begin of the next at one go, while the surface is in the cache.
    for_each(is_active, [&](SurfaceSolve& surface, Progress& each, const std::function<void(ConstraintKind)>& told) {
      if (iteration > 0) end_iteration(surface, each, told);
      if (!each.done) begin_iteration(surface, each, elapsed, told);
    });
    if (std::all_of(progress.begin(), progress.end(), is_done)) break;
    if (coupling.project && iteration % coupling_refresh == 0) coupling.refresh(movers);
    couple();
  }

  // What contact takes from the volume, or the volume presses into a neighbor, is shared out between them, by where
  // everything is now.
  int rounds = 0;
  for (const SurfaceSolve& surface : surfaces) rounds = std::max(rounds, surface.settings.settling_rounds);
  int round = 0;
  const auto is_settling = [&](std::size_t i) {
    return movers.move(i) && (round >= rounds || round < surfaces[i].settings.settling_rounds);
  };
  const auto project = [&](ConstraintKind kind) {
    for_each(is_settling, [&](SurfaceSolve& surface, Progress&, const std::function<void(ConstraintKind)>& told) {
      const Index touching = surface.report.contacts;
      project_kind(kind, *surface.system, *surface.placements, surface.settings, *surface.state, surface.report);
      // Where settling leaves nothing to push, what was pushed before still touches.
      surface.report.contacts = std::max(surface.report.contacts, touching);
      told(kind);
    });
  };
  const auto pull_together = [&] {
    project(ConstraintKind::stretch_limit);
    for_each(is_settling, [&](SurfaceSolve& surface, Progress&, const std::function<void(ConstraintKind)>&) {
      keep_listed(surface);
    });
    for (ConstraintKind kind : kinds_after_contact) project(kind);
  };
  const auto settle_once = [&] {
    project(ConstraintKind::volume);
    couple();
    pull_together();
  };
  const auto settle = [&] {
    if (coupling.refresh) coupling.refresh(movers);
    round = 0;
    for_each(is_settling, [&](SurfaceSolve& surface, Progress&, const std::function<void(ConstraintKind)>&) {
      keep_listed(surface);
      find_edge_points(*surface.system, *surface.placements, *surface.state);
      look_everywhere(surface.state->stretched);
    });
    // What mending took to its place may have stretched edges far, and what contact does in each round some.
    for (int pass = 0; pass < limit_passes; ++pass) project(ConstraintKind::stretch_limit);
    for (; round < rounds; ++round) settle_once();
    const Movers settled = movers;
    for (; round < rounds + further_rounds && keep_movers(surfaces, is_squeezed, movers); ++round) settle_once();
    movers = settled;
  };
  if (rounds == 0) return;
  settle();
  for (int attempt = 0; attempt < mending_attempts && coupling.mend && coupling.mend(movers, attempt); ++attempt)
    settle();
  // What contact between muscles, or mending, has torn or squeezed recovers without them.
  movers = {};
  const auto is_hurt = [](const SurfaceSolve& surface) { return is_torn(surface) || is_squeezed(surface); };
  for (int pass = 0; pass < recovering_passes && keep_movers(surfaces, is_hurt, movers); ++pass) {
    project(ConstraintKind::volume);
    pull_together();
  }
}

SolveReport solve_substep(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements,
                          const SolveSettings& settings, SurfaceState& state) {
  std::vector<SurfaceSolve> alone = {{&system, &placements, settings, &state, {}}};
  solve_together(alone, {});
  return alone.front().report;
}

bool is_finite(const Particles& particles) {
  return std::all_of(particles.xyzw.begin(), particles.xyzw.end(), [](float value) { return std::isfinite(value); });
}

}  // namespace gracilis
