#pragma once

#include <gracilis/methods/tissue/carry.hpp>
#include <gracilis/methods/tissue/factored_matrix.hpp>
#include <gracilis/methods/tissue/forces.hpp>
#include <gracilis/methods/tissue/minimize.hpp>

#include <shapes.hpp>

namespace gracilis::tissue {

inline constexpr Real width = 0.02, length = 0.12, section = width * width;

inline Real energy_of(const PreparedTissue& muscle, const Surroundings& around, const Points& nodes, Points& gradient) {
  EnergyWorkspace workspace;
  return total_energy(muscle, around, nodes, workspace, gradient);
}

/// A bar of muscle between two bodies that hold all of its ends; there are no bones.
inline Scene bar_scene(const SettingValues& settings) {
  Scene scene;
  scene.bodies = {"lower", "upper"};
  Muscle bar;
  bar.name = "bar";
  bar.surface = shapes::box({0, 0, 0}, {width, width, length});
  bar.attachments = {{"below", AttachmentEnd::origin, 0, {0, 1, 2, 3}},
                     {"above", AttachmentEnd::insertion, 1, {4, 5, 6, 7}}};
  scene.muscles = {bar};
  scene.method.name = "tissue";
  scene.method.settings = {{"cell_size", 0.005},      {"cells_at_least", 0},    {"attachment_stiffness", 1e11},
                           {"fiber_tension", 0.0},    {"fiber_stiffness", 0.0}, {"shear_per_tension", 0.0},
                           {"bulk_per_tension", 0.0}, {"tension_frames", 1},    {"bulk_modulus", 1e7}};
  for (const auto& [key, value] : settings) scene.method.settings[key] = value;
  return scene;
}

/// A bar at rest under its law, its upper end moved.
struct SettledBar {
  PreparedTissue muscle;
  Surroundings around;
  Points nodes;
  Minimized done;
};
inline SettledBar settled(const SettingValues& settings, Real activation, const Vec3& shift) {
  const Scene scene = bar_scene(settings);
  SettledBar bar{prepare_tissue(scene, scene.muscles[0], {}, {}), {}, {}, {}};
  std::vector<RigidTransform> bodies(2, RigidTransform::Identity());
  bodies[1].translation() = shift;
  bar.nodes = bar.muscle.lattice.nodes;
  carry(bar.muscle, std::vector<RigidTransform>(2, RigidTransform::Identity()), bodies, bar.nodes);
  bar.around = surroundings(bar.muscle, bodies, cell_laws(bar.muscle, activation, 1));
  const FactoredMatrix metric(scalar_stiffness(bar.muscle, cell_laws(bar.muscle, activation, 1)));
  bar.done = minimize([&](const Points& x, Points& g) { return energy_of(bar.muscle, bar.around, x, g); },
                      [&](std::span<Points> g) { metric.solve(g); }, {2000, 1e-4, 0.005}, bar.nodes);
  return bar;
}

}  // namespace gracilis::tissue
