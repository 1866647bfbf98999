#include <gracilis/dynamics/solver/constraint_table.hpp>

#include <gracilis/dynamics/constraints/tension.hpp>
#include <gracilis/dynamics/solver/bone_contact.hpp>
#include <gracilis/dynamics/solver/for_each_color.hpp>

#include <algorithm>
#include <atomic>

namespace gracilis {

namespace {

template <class Project>
void project_colors(const ColorOrder& order, SurfaceSolve& surface, const Project& project) {
  std::atomic<Index> limited = 0, skipped = 0;
  for_each_color(order, surface.state->particles, [&](ColorRange range) {
    const ProjectionCounts counts = project(range);
    limited += counts.limited;
    skipped += counts.skipped;
  });
  surface.report.limited_dihedrals += limited;
  surface.report.skipped_constraints += skipped;
}

/// The edges that may come to the strain limit, set up if need be; null where there is no limit.
StrainLimitActiveSet* strained_edges(SurfaceSolve& surface) {
  if (!(surface.settings.strain_limit > 0)) return nullptr;
  build_active_set(surface.system->distances, surface.settings.strain_limit, surface.state->strained);
  return &surface.state->strained;
}

void distance_pass(SurfaceSolve& surface) {
  const DistanceSet& set = surface.system->distances;
  SurfaceState& state = *surface.state;
  StrainLimitActiveSet* const strained = strained_edges(surface);
  if (strained) deactivate_all(*strained);
  project_colors(set.order, surface, [&](ColorRange range) {
    return project_distances(set, range, state.target_length.data(), state.distance_lambda.data(), state.start,
                             state.particles, surface.settings.projection, strained);
  });
}

void tension_pass(SurfaceSolve& surface) {
  if (!(surface.settings.tension.strength > 0)) return;
  const DistanceSet& set = surface.system->tensions;
  SurfaceState& state = *surface.state;
  project_colors(set.order, surface, [&](ColorRange range) {
    return project_tensions(set, range, state.tension_length.data(), surface.settings.tension,
                            state.tension_lambda.data(), state.start, state.particles, surface.settings.projection);
  });
}

void dihedral_pass(SurfaceSolve& surface) {
  const DihedralSet& set = surface.system->dihedrals;
  SurfaceState& state = *surface.state;
  project_colors(set.order, surface, [&](ColorRange range) {
    return project_dihedrals(set, range, state.dihedral_lambda.data(), state.start, state.particles,
                             surface.settings.projection);
  });
}

void volume_pass(SurfaceSolve& surface) {
  SurfaceState& state = *surface.state;
  state.volume = project_volume(surface.system->volume, surface.settings.time_step, surface.settings.pressure,
                                state.volume_lambda, state.volume_gradients, state.particles);
}

void strain_limit_pass(SurfaceSolve& surface) {
  const StrainLimitActiveSet* const strained = strained_edges(surface);
  if (!strained) return;
  const DistanceSet& set = surface.system->distances;
  std::atomic<Index> limited = 0;
  for_each_color(set.order, surface.state->particles, [&](ColorRange range) {
    limited += project_strain_limit(set, range, strained->limit, surface.state->particles, strained);
  });
  surface.report.limited_edges += limited;
}

void shape_limit_pass(SurfaceSolve& surface) {
  if (!surface.settings.shape_limits.any()) return;
  project_shape_limits(surface.system->shape_limits, surface.settings.shape_limits, surface.state->near_shape_limit,
                       surface.state->particles);
}

void sliver_pass(SurfaceSolve& surface) { project_slivers(surface.system->slivers, surface.state->particles); }

void rest_proximity_pass(SurfaceSolve& surface) {
  project_rest_proximities(surface.system->rest_proximities, surface.state->particles);
}

void bone_contact_pass(SurfaceSolve& surface) {
  surface.report.contacts = project_bone_contact(*surface.system, *surface.placements, *surface.state);
}

using enum ConstraintPhase;

constexpr ConstraintRow rows[] = {
    {ConstraintKind::distance, "distance", before_contact, distance_pass},
    {ConstraintKind::tension, "contraction", before_contact, tension_pass},
    {ConstraintKind::dihedral, "dihedral", before_contact, dihedral_pass},
    {ConstraintKind::volume, "volume", before_contact, volume_pass},
    {ConstraintKind::strain_limit, "stretch limit", before_contact, strain_limit_pass},
    {ConstraintKind::shape_limit, "shape limit", settling, shape_limit_pass},
    {ConstraintKind::muscle_contact, "muscle contact", contact, nullptr},  // Coupling::project
    {ConstraintKind::slivers, "sliver", after_contact, sliver_pass},
    {ConstraintKind::rest_proximities, "rest proximity", after_contact, rest_proximity_pass},
    {ConstraintKind::bone_contact, "bone contact", after_contact, bone_contact_pass},
};

const ConstraintRow* row_of(ConstraintKind kind) {
  const auto* const row =
      std::find_if(std::begin(rows), std::end(rows), [kind](const ConstraintRow& each) { return each.kind == kind; });
  return row == std::end(rows) ? nullptr : row;
}

}  // namespace

std::span<const ConstraintRow> constraint_table() { return rows; }

const char* name_of(ConstraintKind kind) {
  const ConstraintRow* const row = row_of(kind);
  return row ? row->name : "none";
}

void project_kind(ConstraintKind kind, SurfaceSolve& surface) {
  const ConstraintRow* const row = row_of(kind);
  if (row && row->project) row->project(surface);
}

}  // namespace gracilis
