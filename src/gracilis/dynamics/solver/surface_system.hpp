#pragma once

#include <gracilis/core/aligned.hpp>
#include <gracilis/dynamics/constraints/dihedral.hpp>
#include <gracilis/dynamics/constraints/distance.hpp>
#include <gracilis/dynamics/constraints/rest_proximity.hpp>
#include <gracilis/dynamics/constraints/shape_limit.hpp>
#include <gracilis/dynamics/constraints/slivers.hpp>
#include <gracilis/dynamics/constraints/strain_limit.hpp>
#include <gracilis/dynamics/constraints/volume.hpp>
#include <gracilis/dynamics/contact/field/face_set.hpp>
#include <gracilis/dynamics/contact/field/near_field.hpp>
#include <gracilis/dynamics/particles.hpp>

#include <vector>

namespace gracilis {

/// A deformable surface as the solver needs it; never changes after preparation.
struct SurfaceSystem {
  Particles rest;  ///< positions in the capture pose, inverse masses
  DistanceSet distances;
  DistanceSet tensions;  ///< segments that pull while the surface is active; empty for one that never is
  DihedralSet dihedrals;
  VolumeSet volume;
  SliverSet slivers;  ///< what a surface does where its data are too poor for contact with itself
  std::vector<RestProximity> rest_proximities;
  ShapeLimitSet shape_limits;
  FaceSet large_faces;  ///< those that contact tests between their edges, too
  std::vector<FieldContactSet> contacts;
};

/// What changes from step to step. A copy is a checkpoint.
struct SurfaceState {
  Particles particles;
  Particles start;                      ///< where the substep began
  AlignedVector<float> velocities;      ///< 3 n, m/s; dynamic mode only
  AlignedVector<float> target_length;   ///< m, per distance slot
  AlignedVector<float> tension_length;  ///< m, per tension slot: what it aims at
  AlignedVector<float> distance_lambda, tension_lambda, dihedral_lambda;
  double volume_lambda = 0;
  double volume = 0;                      ///< m³, before the last volume projection
  AlignedVector<float> volume_gradients;  ///< workspace
  std::vector<NearField> near;            ///< per contact set; workspace
  StrainLimitActiveSet strained;          ///< workspace
  std::vector<Index> near_shape_limit;    ///< particles; workspace
  Particles listed;                       ///< where the particles were when what is near was listed; workspace
};

/// A state at rest.
SurfaceState make_state(const SurfaceSystem& system);

/// Sets all multipliers to zero, as at the beginning of a substep.
void reset_multipliers(SurfaceState& state);

}  // namespace gracilis
