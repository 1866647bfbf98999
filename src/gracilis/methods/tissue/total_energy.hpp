#pragma once

#include <gracilis/methods/tissue/preparation.hpp>

#include <Eigen/SparseCore>

#include <vector>

namespace gracilis::tissue {

/// What surrounds a muscle at one instant.
struct Surroundings {
  std::vector<RigidTransform> bodies;    ///< from the capture pose
  std::vector<RigidTransform> inverses;  ///< back to it
  LawLanes laws;
  Points held;                    ///< where points are held, 3 × points; of the free ones it means nothing
  Points tied, gliding;           ///< where ties hold, and the directions that they leave free, 3 × ties
  std::vector<Index> near_begin;  ///< per point and one more: where its bones begin in `near`
  std::vector<Index> near;        ///< bones that the point may touch, of PreparedTissue::bones
};

/// Everything about the bodies there; nothing is near yet.
Surroundings surroundings(const PreparedTissue& muscle, const std::vector<RigidTransform>& bodies,
                          const std::vector<CellLaw>& laws);

/// Points within this distance of touching a bone are near it, m: less than the margin of usual distance fields.
inline constexpr Real near_bones = 0.006;
/// Finds what is near: holds until a point has moved by `near_bones`.
void find_near_bones(const PreparedTissue& muscle, const Points& nodes, Surroundings& around);

/// All energy of a muscle (J) and its derivative by the nodes (3 × n, N). Infinite where a tetrahedron is inverted; the
/// gradient means nothing then. The same bits for any number of threads. `forces` is memory that is kept between calls.
Real total_energy(const PreparedTissue& muscle, const Surroundings& around, const Points& nodes,
                  CornerForces& forces, Points& gradient);

/// A third of the trace of every 3 × 3 block of the second derivatives at rest, in the capture pose: nodes × nodes,
/// N/m. Positive definite.
Eigen::SparseMatrix<Real> scalar_stiffness(const PreparedTissue& muscle, const std::vector<CellLaw>& laws);

/// Where a point of the surface is: at rest plus what its cell has moved it by.
Vec3 point_at(const PreparedTissue& muscle, std::size_t point, const Points& nodes);

/// Where the surface is: rest plus what its cells have moved, 3 × vertices.
Points surface_at(const PreparedTissue& muscle, const Points& nodes);

/// The least volume of a tetrahedron over that at rest.
Real least_volume_ratio(const Lattice& lattice, const Points& nodes);

}  // namespace gracilis::tissue
