#pragma once

#include <gracilis/core/types.hpp>

#include <string>

namespace gracilis {

/// How time passes for a muscle. `quasi_static` carries no velocity from frame to frame; `dynamic` does.
enum class TimeMode { quasi_static, dynamic };

/// Which angle measure the dihedral constraint uses: the stable atan2 or the published arccos.
enum class DihedralFormula { atan2, arccos };

/// What the predicted surface follows: the muscle's fibers, pulled tight among the bones like strings, or a blend of
/// the motions of the bodies that it is attached to.
enum class Skinning { strings, bodies };

/// What keeps fast vertices from passing through bones: nothing; the published test of the direction to the surface; or
/// a limit on the motion in each step along its path.
enum class TunnellingGuard { none, turned_direction, kept_path };

/// Settings of the XPBD method, for one muscle. Defaults are the `physical` preset. The unit, range and meaning shown
/// to users stand in one table, setting_table.cpp; a new setting is one line here and one there.
struct XpbdSettings {
  // Solver
  int iterations = 30;            ///< inner iterations per substep
  int substeps = 1;               ///< outer steps per frame
  Real time_step = 1.0 / 60;      ///< s, per frame
  Real constraint_time_step = 0;  ///< s, used inside distance and dihedral projections; 0: the substep's
  TimeMode time_mode = TimeMode::quasi_static;
  Real damping = 0.9;           ///< factor on velocities per step, dynamic mode
  Vec3 gravity = Vec3::Zero();  ///< m/s²
  Real rayleigh_beta = 0;       ///< 1/s, dissipation of the distance and dihedral constraints
  Real stop_displacement = 0;   ///< m; stop a substep early when no vertex moved further; 0: never
  Real stop_milliseconds = 0;   ///< ms; stop a frame early after this time; 0: never
  Real simulated_edge = 0;      ///< m, edge length of a coarser copy that is simulated in place of the surface; 0: none
  int full_iterations = 0;      ///< on the whole surface, from where its coarser copy takes it
  Real target_fps = 0;  ///< 1/s, rate to hold by fewer iterations and a coarser copy; the scene's largest; 0: none

  // Material
  bool unit_masses = false;            ///< every vertex weighs 1 kg, as published
  Real density = 1060;                 ///< kg/m³
  Real distance_stiffness = 5;         ///< N/m
  bool distance_shape_scaling = true;  ///< scale per edge by A/l²
  bool fiber_anisotropy = true;        ///< scale the distance stiffness by 1 - |u·v|
  Real anisotropy_floor = 0.1;         ///< smallest factor the anisotropy may reach
  Real dihedral_stiffness = 1e-6;      ///< N·m
  bool dihedral_shape_scaling = true;  ///< scale per hinge by 3 l²/A
  DihedralFormula dihedral_formula = DihedralFormula::atan2;
  Real volume_compliance = 0;  ///< m³·m³/J
  Real pressure = 1;           ///< target volume as a multiple of the volume at rest

  // Bone contact
  Real bone_margin = 0.0005;  ///< m, kept between muscle and bone where the gap at rest allows
  bool bone_rest_gap = true;  ///< where the gap at rest is smaller than the margin, keep that gap instead
  bool edge_contact = true;   ///< keep edges and large triangles out of bones, not vertices only
  TunnellingGuard tunnelling = TunnellingGuard::kept_path;
  std::string slide_on_bone;  ///< name of a bone from which the muscle does not lift off; empty: none
  Real slide_reach = 0.005;   ///< m; vertices this near to it at rest keep their distance

  // What this project adds to the published method
  bool predictor = true;                  ///< carry free vertices with the bones before solving
  Skinning skinning = Skinning::strings;  ///< what the predictor follows
  Real tendon_length = 0.03;              ///< m from attachments, graded from tendon to belly; 0: no tendons
  Real step_turn = radians(2);  ///< rad; a frame that turns bones further is taken in several steps; 0: in one
  int settling_rounds = 4;         ///< of volume and contact alone, after the last iteration
  Real shape_recovery = 0.03;      ///< share of its displacement that a vertex gives up per step
  Real hinge_limit = 0.05;         ///< largest motion by one hinge projection, as a share of its edge; 0: off
  Real stretch_limit = 2.5;        ///< longest an edge may become, over its length at rest; 0: no limit
  bool slack_uptake = true;        ///< edges aim at their lengths on the carried surface, so that nothing folds
};

/// How muscles keep out of each other: not at all, point against surface and edge against edge, or as published by
/// pairs of vertices.
enum class MuscleContact { none, surface, virtual_edges };

/// Along which line the ends of a virtual edge are pushed apart: their own (the plain push), or leaned toward where
/// they were before, by unit vectors or by vectors as they are (Havlíček 2024, Eqs. 5.2 and 5.3).
enum class VirtualEdgeResolution { push, unit_sum, vector_sum };

/// What becomes of a virtual edge that ended on the same two vertices as another.
enum class CoincidingEdges { keep, drop, reseed };

/// Settings of contact between muscles and of a muscle with itself, for all muscles of a scene.
struct ContactSettings {
  MuscleContact muscle = MuscleContact::surface;
  bool self = true;       ///< a muscle keeps out of itself; surface contact only
  Real margin = 0.0003;   ///< m, kept between muscles where the gap at rest allows
  Real reach = 0.003;     ///< m, farthest that another muscle is looked for
  Real friction = 0;      ///< Coulomb's coefficient
  Real cohesion = 0;      ///< m, farthest that what touches at rest may part; 0: as it likes
  int update_period = 5;  ///< frames after which contact is found from nothing but where everything is

  // Virtual edges only
  Real seed_reach = 0.02;          ///< m, longest that an edge may be where it is seeded
  int walk_steps = 100;            ///< of one walk at most
  Real contact_distance = 0.002;   ///< m, kept between vertices of different muscles
  bool adaptive_distance = false;  ///< raise it to what the ends came nearer in the step
  VirtualEdgeResolution resolution = VirtualEdgeResolution::vector_sum;
  bool reset_edges = false;  ///< walks begin at the seeds in every iteration, not where the last ended
  CoincidingEdges coinciding_edges = CoincidingEdges::keep;
};

/// Settings of the distance fields of all bones.
struct DistanceFieldSettings {
  Real cell_size = 0.001;      ///< m; used where resolution is 0
  int resolution = 0;          ///< cells along each axis, as published; 0: from cell_size
  Real domain_margin = 0.012;  ///< m around the bone's bounding box
  Real domain_factor = 1;      ///< bounding box scaled by this factor about its center, as published
};

/// Settings of the optional preparation of a scene's muscles before anything else is done with them.
struct PrepareSettings {
  Real edge_length = 0.003;   ///< m, of the new triangles; 0 keeps the triangles
  int remeshing_rounds = 10;  ///< of splitting, collapsing, flipping and smoothing
  int smoothing_rounds = 0;   ///< of the whole surface, before it is remeshed
  int rounding_rounds = 20;   ///< of sharp rims and spikes
  Real muscle_gap = 0.0003;   ///< m, kept between two muscles
  Real bone_gap = 0.0003;     ///< m, kept between a muscle and a bone
};

}  // namespace gracilis
