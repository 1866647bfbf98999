#pragma once

#include <gracilis/dynamics/contact/field/field_contact_set.hpp>
#include <gracilis/dynamics/contact/surface/contact_world.hpp>
#include <gracilis/dynamics/havlicek_2024/virtual_edges.hpp>
#include <gracilis/methods/predictor.hpp>
#include <gracilis/scene/scene.hpp>

#include <string>

/// Settings of the XPBD method, one struct per concern. Defaults are the `physical` preset. The unit, range and meaning
/// shown to users stand in one table per struct, settings.cpp; a new setting is one line here and one there.
namespace gracilis {

/// How time passes for a muscle. `quasi_static` carries no velocity from frame to frame; `dynamic` does.
enum class TimeMode { quasi_static, dynamic };
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 2> choices_of(TimeMode) { return {"quasi_static", "dynamic"}; }

/// Which angle measure the dihedral constraint uses: the stable atan2 or the published arccos.
enum class DihedralFormula { atan2, arccos };
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 2> choices_of(DihedralFormula) { return {"atan2", "arccos"}; }

/// What the predicted surface follows: the muscle's fibers, pulled tight among the bones like strings, or a blend of
/// the motions of the bodies that it is attached to.
enum class Skinning { strings, bodies };
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 2> choices_of(Skinning) { return {"strings", "bodies"}; }

/// Which way fibers run at an edge: along the gradient of the harmonic coordinate from origins to insertions, or as the
/// nearest fiber does (Havlíček 2024, eq. 4.1).
enum class FiberDirection { harmonic, nearest_fiber };
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 2> choices_of(FiberDirection) { return {"harmonic", "nearest_fiber"}; }

/// The names of the choices, in their order.
constexpr std::array<std::string_view, 3> choices_of(MotionGuard) { return {"none", "turned_direction", "kept_path"}; }

/// How a step is solved.
struct SolverSettings {
  int iterations = 30;            ///< inner iterations per substep
  int substeps = 1;               ///< outer steps per frame
  Real time_step = 1.0 / 60;      ///< s, per frame; 0: the motion's
  Real constraint_time_step = 0;  ///< s, used inside distance and dihedral projections; 0: the substep's
  TimeMode time_mode = TimeMode::quasi_static;
  Real damping = 0.9;           ///< factor on velocities per step, dynamic mode
  Vec3 gravity = Vec3::Zero();  ///< m/s²
  Real rayleigh_beta = 0;       ///< N·s/m, N·m·s: dissipation of edges, contractions and dihedrals
  Real stop_displacement = 0;   ///< m; stop a substep early when no vertex moved further; 0: never
  Real stop_milliseconds = 0;   ///< ms; stop a frame early after this time; 0: never
  Real step_turn = radians(2);  ///< rad; a frame that turns bones further is taken in several steps; 0: in one
  int settling_rounds = 4;      ///< of volume and contact alone, after the last iteration
  Real dihedral_limit = 0.05;   ///< largest motion by one dihedral projection, as a share of its edge; 0: off
  Real stretch_limit = 2.5;     ///< longest an edge may become, over its length at rest; 0: no limit
  Real spike_limit = 1.5;       ///< farthest a vertex may stand out of its neighbors, in edges; 0: no limit
  Real thickness_limit = 2.5;   ///< thickest a place may become, over its thickness at rest; 0: no limit
  Real thinness_limit = 4;      ///< thinnest a place may become, its thickness at rest over it; 0: no limit
};

/// How much of a surface is simulated, and how fast.
struct DetailSettings {
  Real simulated_edge = 0;  ///< m, edge length of a coarser copy that is simulated in place of the surface; 0: none
  int full_iterations = 0;  ///< on the whole surface, from where its coarser copy takes it
  Real target_fps = 0;      ///< 1/s, rate to hold by fewer iterations and a coarser copy; 0: none
};

/// What a muscle's surface is made of.
struct MaterialSettings {
  bool unit_masses = false;            ///< every vertex weighs 1 kg, as published
  Real density = 1060;                 ///< kg/m³
  Real distance_stiffness = 5;         ///< N/m
  bool distance_shape_scaling = true;  ///< scale per edge by A/l²
  bool fiber_anisotropy = true;        ///< scale the distance stiffness by 1 - |u·v|
  FiberDirection fiber_direction = FiberDirection::harmonic;
  Real anisotropy_floor = 0.1;         ///< smallest factor the anisotropy may reach
  Real dihedral_stiffness = 1e-6;      ///< N·m
  bool dihedral_shape_scaling = true;  ///< scale per dihedral by 3 l²/A
  DihedralFormula dihedral_formula = DihedralFormula::atan2;
  Real volume_compliance = 0;  ///< m³·m³/J
  Real pressure = 1;           ///< target volume as a multiple of the volume at rest
};

/// How a muscle keeps out of bones.
struct BoneContactSettings {
  Real bone_margin = 0.0005;  ///< m, kept between muscle and bone where the gap at rest allows
  bool bone_rest_gap = true;  ///< where the gap at rest is smaller than the margin, keep that gap instead
  bool edge_contact = true;   ///< keep edges and large triangles out of bones, not vertices only
  MotionGuard tunnelling = MotionGuard::kept_path;
  std::string slide_on_bone;  ///< name of a bone from which the muscle does not lift off; empty: none
  Real slide_reach = 0.005;   ///< m; vertices this near to it at rest keep their distance
};

/// Where the solver begins.
struct PredictorSettings {
  Predictor predictor = Predictor::carried;
  Skinning skinning = Skinning::strings;  ///< what the predictor follows
  Real tendon_length = 0.03;              ///< m from attachments, graded from tendon to belly; 0: no tendons
  Real shape_recovery = 0.03;             ///< share of its displacement that a vertex gives up per step
  bool slack_uptake = true;               ///< edges aim at their lengths on the skinned surface, so that nothing folds
};

/// All of one muscle.
struct XpbdSettings : SolverSettings, DetailSettings, MaterialSettings, BoneContactSettings, PredictorSettings {};

template <>
std::span<const Setting<XpbdSettings>> setting_table();  ///< a row for each setting

/// The settings of one muscle of a scene: its own, else the scene's, else the defaults.
XpbdSettings xpbd_settings(const Scene& scene, const Muscle& muscle);

/// How muscles keep out of each other: not at all, point against surface and edge against edge, or as published by
/// pairs of vertices.
enum class MuscleContact { none, surface, virtual_edges };
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 3> choices_of(MuscleContact) { return {"none", "surface", "virtual-edges"}; }
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 3> choices_of(EdgeResolution) { return {"push", "unit_sum", "vector_sum"}; }
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 3> choices_of(CoincidingEdgeRule) { return {"keep", "drop", "reseed"}; }

/// Contact between muscles and of a muscle with itself, beside how surfaces or virtual edges meet.
struct ContactSettings {
  MuscleContact muscle = MuscleContact::surface;
  bool self = true;      ///< a muscle keeps out of itself; surface contact only
  Real margin = 0.0003;  ///< m, kept between muscles where the gap at rest allows
  Real reach = 0.003;    ///< m, farthest that another muscle is looked for
};

template <>
std::span<const Setting<ContactSettings>> setting_table();  ///< a row for each setting
template <>
std::span<const Setting<SurfaceContactSettings>> setting_table();  ///< a row for each setting
template <>
std::span<const Setting<VirtualEdgeSettings>> setting_table();  ///< a row for each setting

/// The scene's, else the defaults.
ContactSettings contact_settings(const Scene& scene);

}  // namespace gracilis
