#pragma once

#include <gracilis/dynamics/constraints/constraint_sets.hpp>
#include <gracilis/dynamics/constraints/projection.hpp>
#include <gracilis/dynamics/constraints/slivers.hpp>
#include <gracilis/dynamics/constraints/tight_places.hpp>
#include <gracilis/dynamics/contact/field/field_contact.hpp>
#include <gracilis/dynamics/movers.hpp>
#include <gracilis/dynamics/particles.hpp>

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace gracilis {

/// A deformable surface as the solver needs it; never changes after preparation.
struct SurfaceSystem {
  Particles rest;  ///< positions in the capture pose, inverse masses
  DistanceSet distances;
  DistanceSet contractions;  ///< segments that pull while the surface is active; empty for one that never is
  HingeSet hinges;
  VolumeSet volume;
  SliverSet slivers;  ///< what a surface does where its data are too poor for contact with itself
  std::vector<TightPlace> tight_places;
  FaceSet large_faces;  ///< those that contact tests between their edges, too
  std::vector<FieldContactSet> contacts;
};

/// What changes from step to step. A copy is a checkpoint.
struct SurfaceState {
  Particles particles;
  Particles start;                          ///< where the substep began
  AlignedVector<float> velocities;          ///< 3 n, m/s; dynamic mode only
  AlignedVector<float> target_length;       ///< m, per distance slot
  AlignedVector<float> contraction_length;  ///< m, per contraction slot
  AlignedVector<float> distance_lambda, contraction_lambda, hinge_lambda;
  double volume_lambda = 0;
  double volume = 0;                      ///< m³, before the last volume projection
  AlignedVector<float> volume_gradients;  ///< workspace
  std::vector<NearField> near;            ///< per contact set; workspace
  StretchWatch stretched;                 ///< workspace
  Particles listed;                       ///< where the particles were when what is near was listed; workspace
};

/// How one substep is solved.
struct SolveSettings {
  int iterations = 30;
  int settling_rounds = 0;          ///< of volume and contact alone after the last iteration
  double time_step = 1.0 / 60;      ///< s
  ProjectionParameters projection;  ///< its time step is that of distances and hinges
  float contraction = 0;            ///< factor on the stiffness of contractions; 0: they are not projected
  double pressure = 1;              ///< target volume over the volume at rest
  float stretch_limit = 0;          ///< longest an edge may be, over its length at rest; 0: none
  float stop_displacement = 0;      ///< m; stop early when no particle moved further in an iteration; 0: never
  double stop_milliseconds = 0;     ///< stop early after this time; 0: never
};

/// Kinds of constraints.
enum class ConstraintKind {
  none,
  distance,
  contraction,
  dihedral,
  volume,
  stretch_limit,
  muscle_contact,
  slivers,
  tight_places,
  bone_contact
};

/// The kinds that one surface alone has, in the order in which an iteration projects them. Contact between surfaces
/// comes between `kinds_before_contact` and `kinds_after_contact`; bone contact is last, so that nothing pushes back
/// into a bone.
inline constexpr std::array projection_order = {ConstraintKind::distance,      ConstraintKind::contraction,
                                                ConstraintKind::dihedral,      ConstraintKind::volume,
                                                ConstraintKind::stretch_limit, ConstraintKind::slivers,
                                                ConstraintKind::tight_places,  ConstraintKind::bone_contact};
inline constexpr std::span<const ConstraintKind> kinds_before_contact = std::span(projection_order).first(5);
inline constexpr std::span<const ConstraintKind> kinds_after_contact = std::span(projection_order).subspan(5);
const char* name_of(ConstraintKind kind);

struct SolveReport {
  int iterations = 0;
  Index contacts = 0;        ///< most that were touching in the last iteration or while settling
  Index limited_hinges = 0;  ///< sums over all iterations
  Index limited_edges = 0;
  Index skipped_constraints = 0;
  double milliseconds = 0;
};

/// A state at rest.
SurfaceState make_state(const SurfaceSystem& system);

/// One projection of all constraints of a kind. The solver's loop is made of these; benchmarks and tests call them
/// alone.
void project_kind(ConstraintKind kind, const SurfaceSystem& system, const std::vector<FieldPlacement>& placements,
                  const SolveSettings& settings, SurfaceState& state, SolveReport& report);

/// Lists again what is near each obstacle.
void refresh_contacts(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements, SurfaceState& state);

/// Before a substep moves obstacles or particles: on which side of each obstacle every particle is.
void remember_sides(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements, SurfaceState& state);

/// One surface's part in a solve. The state's particles are the prediction on entry and the solution on return.
struct SurfaceSolve {
  const SurfaceSystem* system = nullptr;
  const std::vector<FieldPlacement>* placements = nullptr;
  SolveSettings settings;
  SurfaceState* state = nullptr;
  SolveReport report;
};

/// What acts between surfaces in each iteration; empty functions: nothing. Those not among the movers have not moved
/// since the last look and stay where they are.
struct Coupling {
  std::function<void(const Movers&)> refresh;   ///< looks again at what is near what
  std::function<Index(const Movers&)> project;  ///< returns how many contacts pushed
  /// Mends those of the movers that settled but cannot stay, and leaves none else among them; whether there was any.
  std::function<bool(Movers&, int attempt)> mend = {};
};

/// Told after each projection of a kind on a surface.
using SolveWatch = std::function<void(std::size_t surface, ConstraintKind kind)>;

/// Resets the multipliers and iterates over all surfaces in step: distances, contractions, hinges, volume, stretch
/// limit, contact between surfaces, slivers, tight places, bone contact (XPBD; Macklin, Müller, Chentanez 2016). Free
/// particles with a fixed neighborhood, coinciding ends and flat triangles are survived; they are counted as skipped.
/// Surfaces that stop early wait for the others. At the end volume and contact alone settle; after each of a few
/// attempts at mending those that were mended do so again, among the others, which stay.
void solve_together(std::vector<SurfaceSolve>& surfaces, const Coupling& coupling, const SolveWatch& watch = {});

/// The same for one surface alone.
SolveReport solve_substep(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements,
                          const SolveSettings& settings, SurfaceState& state);

/// True when every coordinate is finite.
bool is_finite(const Particles& particles);

}  // namespace gracilis
