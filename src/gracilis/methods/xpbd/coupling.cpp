#include <gracilis/methods/xpbd/coupling.hpp>

#include <gracilis/dynamics/contact/surface/broad_phase.hpp>
#include <gracilis/dynamics/contact/surface/narrow_phase.hpp>
#include <gracilis/dynamics/contact/surface/penetration_repair.hpp>
#include <gracilis/dynamics/contact/surface/surface_contact.hpp>
#include <gracilis/dynamics/contact/surface/surface_ties.hpp>
#include <gracilis/dynamics/contact/surface/untangling.hpp>

namespace gracilis::xpbd {

namespace {

Coupling couple_by_surfaces(const std::vector<MuscleStep>& steps, const std::vector<Particles>& predicted,
                            const ContactWorld& world, ContactWorldState& state) {
  const auto particles = particles_of<Particles*>(steps);
  const auto seen = particles_of<const Particles*>(steps);
  std::vector<const Particles*> start;
  for (const MuscleStep& step : steps) start.push_back(&step.state->start);
  update_broad_phase(world, seen, state);
  return {[&world, &state, seen](const Movers& movers) { update_narrow_phase(world, seen, state, movers); },
          [&world, &state, start, particles](const Movers& movers) {
            return project_candidates(world, state, start, particles, movers);
          },
          [&world, &state, seen](const Movers& movers) { return find_tangles(world, state, seen, movers); },
          [&world, particles, &predicted](const std::vector<Tangle>& tangles, int attempt) {
            untangle(world, tangles, attempt, predicted, particles);
          },
          [&world, &state, particles] { return repair_penetrations(world, state, particles); }};
}

Coupling couple_by_edges(const std::vector<MuscleStep>& steps, const VirtualEdgeWorld& world, VirtualEdgeState& state) {
  const auto particles = particles_of<Particles*>(steps);
  adapt_distances(world, particles_of<const Particles*>(steps), state);
  return {[](const Movers&) {},
          [&world, &state, particles](const Movers&) { return project_virtual_edges(world, particles, state); }};
}

Coupling couple_by_contact(const std::vector<MuscleStep>& steps, const std::vector<Particles>& predicted,
                           const MuscleContactWorld& world, MuscleContactState& state) {
  if (!world.surfaces.pairs.empty()) return couple_by_surfaces(steps, predicted, world.surfaces, state.surfaces);
  if (!world.edges.pairs.empty()) return couple_by_edges(steps, world.edges, state.edges);
  return {[](const Movers&) {}, [](const Movers&) { return Index{0}; }};
}

}  // namespace

Coupling couple(const std::vector<MuscleStep>& steps, const std::vector<Particles>& predicted,
                const MuscleContactWorld& world, MuscleContactState& state) {
  if (!world.meets()) return {};
  Coupling coupling = couple_by_contact(steps, predicted, world, state);
  if (!world.ties.any()) return coupling;
  coupling.project = [&ties = world.ties.surfaces, project = std::move(coupling.project),
                      particles = particles_of<Particles*>(steps)](const Movers& movers) {
    const Index pushed = project(movers);
    project_ties(ties, particles, movers);
    return pushed;
  };
  return coupling;
}

}  // namespace gracilis::xpbd
