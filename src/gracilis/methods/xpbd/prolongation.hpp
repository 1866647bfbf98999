#pragma once

#include <gracilis/anatomy/resolution/coarser_muscle.hpp>
#include <gracilis/methods/xpbd/motion.hpp>
#include <gracilis/scene/pose.hpp>

#include <array>
#include <vector>

namespace gracilis::xpbd {

/// How a surface follows a coarser copy of itself: the bodies carry it as if there were no copy, and where it is
/// displaced from that, as the copy is: linearly between its vertices. All detail below the copy's triangles moves
/// rigidly.
struct Prolongation {
  std::vector<Index> picked;                  ///< per particle of the copy: the same one of the surface
  std::vector<std::array<Index, 3>> corners;  ///< per particle of the surface: those of the copy around it ...
  std::vector<Eigen::Vector3f> weights;       ///< ... and their shares, sum 1
};

/// Binds each particle to the nearest triangle of the copy, out of those around the vertex that it was drawn onto and
/// around that one's neighbors: through a thin sheet the nearest of all would be on its other side. `copy` says how the
/// copy's vertices and the scene's belong together. The copy takes over the surface's carrier shares.
Prolongation prepare_prolongation(const CoarserMuscle& copy, const PreparedMuscle& full, PreparedMuscle& coarse);

/// Where the surface is when its copy is in the state `coarse_state`, into `particles`, which say which are free.
/// `full_state` says where strings carry the surface in this pose.
void prolong(const Prolongation& prolongation, const PreparedMuscle& coarse, const MuscleState& coarse_state,
             const PreparedMuscle& full, const MuscleState& full_state, const Pose& pose, Particles& particles);

/// Puts the copy's particles where the surface's are.
void restrict_to_copy(const Prolongation& prolongation, const PreparedMuscle& full, const Particles& particles,
                      const PreparedMuscle& coarse, Particles& coarse_particles);

}  // namespace gracilis::xpbd
