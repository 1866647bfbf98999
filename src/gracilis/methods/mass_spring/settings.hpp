#pragma once

#include <gracilis/scene/setting_values.hpp>

namespace gracilis {

/// Which particles a spring joins.
enum class SpringLayout {
  cubic_6,   ///< rows along fibers, and the particles of as high a number on the fibers beside
  cubic_26,  ///< the diagonals of that lattice, too
  delaunay,  ///< edges of the Delaunay tetrahedra of all particles
  nearest    ///< each with its nearest ones
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 4> choices_of(SpringLayout) {
  return {"cubic-6", "cubic-26", "delaunay", "nearest"};
}

/// Which particles move with a bone and are not moved by springs.
enum class FixedNear {
  attachments,  ///< those near an attached vertex, with its body
  bones         ///< those near any bone (published)
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 2> choices_of(FixedNear) { return {"attachments", "bones"}; }

/// Where particles are before springs move them.
enum class MassSpringCarry {
  bodies,       ///< carried by a blend of the motions of the bodies that the muscle is attached to
  nearest_bone  ///< each as the bone nearest to it (published)
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 2> choices_of(MassSpringCarry) { return {"bodies", "nearest-bone"}; }

/// What springs go on from.
enum class MassSpringStart {
  capture,  ///< the capture pose, every frame anew (published): a shape follows from its pose alone
  last      ///< the last frame
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 2> choices_of(MassSpringStart) { return {"capture", "last"}; }

/// How velocities are damped.
enum class DampingRule {
  critical,  ///< eq. 2.10, for the mean stiffness
  fitted,    ///< eq. 2.11
  none
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 3> choices_of(DampingRule) { return {"critical", "fitted", "none"}; }

/// What keeps particles out of bones.
enum class MassSpringBones {
  fields,   ///< the bones' distance fields, and the surface's vertices, too
  spheres,  ///< spheres that stand for the bones' surfaces (published)
  none
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 3> choices_of(MassSpringBones) { return {"fields", "spheres", "none"}; }

/// Of one muscle; those that all muscles share are read from the scene.
struct MassSpringSettings {
  int fiber_count = 64;
  int particles_per_fiber = 20;
  int seed = 1;  ///< of the first steps along fibers
  SpringLayout layout = SpringLayout::nearest;
  int neighbors = 18;            ///< of the layout `nearest`
  Real spring_material = 0.001;  ///< N: stiffness times rest length
  Real shortest_spring = 0.3;    ///< shorter springs are as stiff as this share of the mean rest length
  Real particle_mass = 1;        ///< kg
  DampingRule damping_rule = DampingRule::critical;
  FixedNear fixed_near = FixedNear::attachments;
  Real fixed_distance = 0.005;  ///< m
  MassSpringCarry carry_particles = MassSpringCarry::bodies;
  MassSpringStart start_from = MassSpringStart::capture;  ///< shared
  int iterations = 100;                                   ///< shared, per frame, at most
  Real stop_displacement = 0;                             ///< shared, m; 0: off
  Real stop_milliseconds = 0;                             ///< shared; 0: off
  Real verlet_step = 0.4;                                 ///< shared, s of the springs' own time
  Real smallest_step = 0;                                 ///< shared, s; above 0 steps are adaptive
  bool limit_step = true;                                 ///< shared, to where Verlet's scheme is stable
  MassSpringBones bone_collision = MassSpringBones::fields;
  bool muscle_collision = true;  ///< shared: spheres of muscles keep out of each other
  bool refit_only = false;       ///< shared: of the trees of spheres
  int bone_sphere_rings = 2;     ///< shared: of vertices around the root of a bone's sphere
  int surface_particles = 8;     ///< that a vertex follows
  int surface_smoothing = 20;    ///< rounds
  bool hold_attachments = true;  ///< attached vertices move exactly with their bodies
  Real tendon_length = 0.03;     ///< m from attachments, graded from tendon to belly; 0: no tendons
  Real bone_margin = 0.0005;     ///< m
  bool bone_rest_gap = true;     ///< where there is less at rest, keep that
};

template <>
std::span<const Setting<MassSpringSettings>> setting_table();  ///< a row for each setting

}  // namespace gracilis
