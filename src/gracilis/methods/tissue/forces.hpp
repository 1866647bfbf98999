#pragma once

#include <gracilis/methods/tissue/total_energy.hpp>
#include <gracilis/scene/muscle_forces.hpp>
#include <gracilis/scene/twist.hpp>

namespace gracilis::tissue {

/// What a muscle pulls by at the points that one of its ends is attached by.
Wrench attachment_wrench(const PreparedTissue& muscle, const Surroundings& around, const Points& nodes,
                         AttachmentEnd end);

/// Tension of all fibers together, N: the integral of their tension over a section, averaged along the muscle.
Real mean_tension(const PreparedTissue& muscle, const std::vector<CellLaw>& laws, const Points& nodes);
/// The tension of each fiber (N), averaged along it; each stands for an equal share of the muscle.
std::vector<Real> fiber_tensions(const PreparedTissue& muscle, const std::vector<CellLaw>& laws, const Points& nodes);

/// All that the muscle does to bodies and bones where its nodes are at `nodes`. `coordinates`: per coordinate, how it
/// moves every body.
MuscleForces muscle_forces(const PreparedTissue& muscle, const Surroundings& around, const std::vector<CellLaw>& laws,
                           const Points& nodes, const std::vector<std::vector<Twist>>& coordinates);

/// Tension per area at rest along the fibers at the surface's vertices, Pa; between cells it is blended.
Eigen::VectorXd vertex_fiber_stresses(const PreparedTissue& muscle, const std::vector<CellLaw>& laws,
                                      const Points& nodes);

}  // namespace gracilis::tissue
