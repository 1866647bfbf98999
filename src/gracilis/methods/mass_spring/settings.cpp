#include <gracilis/methods/mass_spring/settings.hpp>

#include <gracilis/methods/shared_rows.hpp>

namespace gracilis {

template <>
std::span<const Setting<MassSpringSettings>> setting_table() {
  using S = MassSpringSettings;
  static const Setting<S> table[] = {
      {"fiber_count", &S::fiber_count, "", 1, 10000,
       "Fibers that particles lie on, where the scene gives the muscle none."},
      {"particles_per_fiber", &S::particles_per_fiber, "", 3, 1000,
       "Particles on each fiber, at equal distances but for the first and the last step."},
      {"seed", &S::seed, "", 0, 1000000, "Of the random numbers that say how long the first step of each fiber is."},
      {"layout", &S::layout, "", 0, 0,
       "Which particles springs join: 'cubic-6' and 'cubic-26' those beside each other on and across fibers, "
       "'delaunay' "
       "those that share a tetrahedron, 'nearest' each with its nearest."},
      {"neighbors", &S::neighbors, "", 3, 100, "How many nearest particles each is joined with by 'nearest'."},
      {"spring_material", &S::spring_material, "N", 1e-6, 1e3,
       "Stiffness of a spring times its length at rest. 0.001 N and 1 kg make the published 1/length in millimetres."},
      {"shortest_spring", &S::shortest_spring, "", 0, 1,
       "Springs that are shorter than this share of the mean are as stiff as that length makes them; 0: as published."},
      {"particle_mass", &S::particle_mass, "kg", 1e-6, 1e3, "Mass of each particle."},
      {"damping_rule", &S::damping_rule, "", 0, 0,
       "How motion is damped: 'critical' for a particle on one spring of the mean stiffness, 'fitted' as published for "
       "particles on six springs, or 'none'."},
      {"fixed_near", &S::fixed_near, "", 0, 0,
       "Particles nearer than 'fixed_distance' to attached vertices ('attachments') or to any bone ('bones', as "
       "published) move with that body."},
      {"fixed_distance", &S::fixed_distance, "m", 0, 0.1, "How near that is."},
      {"carry_particles", &S::carry_particles, "", 0, 0,
       "Where particles are before springs move them: carried by a blend of the motions of the bodies that the muscle "
       "is attached to ('bodies'), or each as the bone nearest to it ('nearest-bone', as published)."},
      {"start_from", &S::start_from, "", 0, 0,
       "What springs go on from: the capture pose, every frame anew ('capture', as published), or the 'last' frame.",
       true},
      {"iterations", &S::iterations, "", 1, 100000, "How often particles are moved per frame, at most.", true},
      {"stop_displacement", &S::stop_displacement, "m", 0, 1,
       "A frame ends early once the mean motion of particles in an iteration is less; 0 never ends it early.", true},
      {"stop_milliseconds", &S::stop_milliseconds, "ms", 0, 1e6,
       "A frame ends early after this time, which makes results depend on the machine; 0 never ends it early.", true},
      {"verlet_step", &S::verlet_step, "s", 1e-4, 100, "Time step of the springs, in a time of their own.", true},
      {"smallest_step", &S::smallest_step, "s", 0, 100,
       "Above 0 steps are adaptive: as long as no sphere moves by more than its radius, at least this and at most "
       "'verlet_step'; 0 takes 'verlet_step' always.",
       true},
      {"limit_step", &S::limit_step, "", 0, 0,
       "Take no longer steps than those in which the stiffest particle's springs are stable; 'smallest_step' gives "
       "way.",
       true},
      {"bone_collision", &S::bone_collision, "", 0, 0,
       "What keeps the muscle out of bones: their distance 'fields', 'spheres' about their surfaces as published, or "
       "'none'."},
      {"muscle_collision", &S::muscle_collision, "", 0, 0, "Whether spheres keep muscles out of each other.", true},
      {"refit_only", &S::refit_only, "", 0, 0,
       "Boxes around spheres are only refitted, never divided anew while a frame is made.", true},
      {"bone_sphere_rings", &S::bone_sphere_rings, "", 1, 2, "Rings of vertices that one sphere of a bone stands for.",
       true},
      {"surface_particles", &S::surface_particles, "", 1, 100, "How many nearest particles a surface vertex follows."},
      {"surface_smoothing", &S::surface_smoothing, "", 0, 1000,
       "Rounds of smoothing of what particles add to the blend of the bodies' motions; 0: as published."},
      {"hold_attachments", &S::hold_attachments, "", 0, 0,
       "Attached vertices move exactly with their bodies; otherwise they follow particles, as published."},
      tendon_length_row<S>(),
      bone_margin_row<S>(),
      bone_rest_gap_row<S>(),
  };
  return table;
}

}  // namespace gracilis
