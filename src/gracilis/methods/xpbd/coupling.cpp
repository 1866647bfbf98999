#include <gracilis/methods/xpbd/coupling.hpp>

#include <gracilis/dynamics/contact/surface/surface_contact.hpp>
#include <gracilis/dynamics/contact/surface/surface_follow.hpp>
#include <gracilis/dynamics/contact/surface/surface_mending.hpp>
#include <gracilis/dynamics/contact/surface/surface_search.hpp>
#include <gracilis/dynamics/contact/surface/surface_ties.hpp>

namespace gracilis::xpbd {

namespace {

Coupling couple_by_surfaces(const std::vector<MuscleStep>& steps, const SurfaceCrowd& crowd, CrowdState& state) {
  const auto particles = particles_of<Particles*>(steps);
  const auto seen = particles_of<const Particles*>(steps);
  std::vector<const Particles*> start;
  for (const MuscleStep& step : steps) start.push_back(&step.state->start);
  find_touches(crowd, seen, state);
  return {[&crowd, &state, seen](const Movers& movers) { follow_touches(crowd, seen, state, movers); },
          [&crowd, &state, start, particles](const Movers& movers) {
            return project_touches(crowd, state, start, particles, movers);
          },
          [&crowd, &state, particles](Movers& movers) { return mend_surfaces(crowd, state, particles, movers); }};
}

Coupling couple_by_edges(const std::vector<MuscleStep>& steps, const VirtualEdgeCrowd& crowd, VirtualEdgeState& state) {
  const auto particles = particles_of<Particles*>(steps);
  adapt_distances(crowd, particles_of<const Particles*>(steps), state);
  return {[](const Movers&) {},
          [&crowd, &state, particles](const Movers&) { return project_virtual_edges(crowd, particles, state); }};
}

Coupling couple_by_contact(const std::vector<MuscleStep>& steps, const MuscleCrowd& crowd, MuscleCrowdState& state) {
  if (!crowd.surfaces.pairs.empty()) return couple_by_surfaces(steps, crowd.surfaces, state.surfaces);
  if (!crowd.edges.pairs.empty()) return couple_by_edges(steps, crowd.edges, state.edges);
  return {[](const Movers&) {}, [](const Movers&) { return Index{0}; }};
}

}  // namespace

Coupling couple(const std::vector<MuscleStep>& steps, const MuscleCrowd& crowd, MuscleCrowdState& state) {
  if (!crowd.meets()) return {};
  Coupling coupling = couple_by_contact(steps, crowd, state);
  if (!crowd.ties.any()) return coupling;
  coupling.project = [&ties = crowd.ties.surfaces, project = std::move(coupling.project),
                      particles = particles_of<Particles*>(steps)](const Movers& movers) {
    const Index pushed = project(movers);
    project_ties(ties, particles, movers);
    return pushed;
  };
  return coupling;
}

}  // namespace gracilis::xpbd
