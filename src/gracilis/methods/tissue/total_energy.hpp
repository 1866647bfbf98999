#pragma once

#include <gracilis/methods/tissue/neighbors.hpp>

#include <Eigen/SparseCore>

#include <span>
#include <vector>

namespace gracilis::tissue {

/// A bone that a point may touch.
struct NearBone {
  Index bone = -1;  ///< of PreparedTissue::bones
  Real clear = 0;   ///< m: until the point has moved so far from where it was seen it does not
};

/// How far points were from a bone when its field was last asked: most are far from most bones, and stay so.
struct CachedBoneQuery {
  Points places;              ///< as the bone in its capture pose saw them, 3 × points
  Eigen::VectorXd distances;  ///< m, then
};

/// What surrounds a muscle at one instant.
struct Surroundings {
  std::vector<RigidTransform> bodies;    ///< from the capture pose
  std::vector<RigidTransform> inverses;  ///< back to it
  LawLanes laws;
  Points held;                    ///< where points are held, 3 × points; of the free ones it means nothing
  Points tied, gliding;           ///< where ties hold, and the directions that they leave free, 3 × ties
  Points seen;                    ///< where it was looked for bones, 3 × points
  std::vector<Index> near_begin;  ///< per point and one more: where its bones begin in `near`
  std::vector<NearBone> near;
  std::vector<CachedBoneQuery> queries;  ///< of the bones; may come from another instant
  std::vector<Index> planes_begin;       ///< per point and one more: where its planes begin in `planes`
  std::vector<ContactPlane> planes;
  std::vector<Index> others;  ///< muscles that it may ever touch, in their order
  /// Springs on the surface's vertices to ends of muscles that lie on it: to where, how stiff (N/m; 0: none) and by
  /// which muscle; empty: there are no such ends.
  Points drawn_to = Points(3, 0);
  Eigen::VectorXd drawn_stiffness;
  std::vector<Index> drawn_by;
};

/// The bones near a point of the muscle, as they were last found.
inline std::span<const NearBone> bones_near(const Surroundings& around, Index point) {
  const auto p = static_cast<std::size_t>(point);
  return std::span(around.near)
      .subspan(static_cast<std::size_t>(around.near_begin[p]),
               static_cast<std::size_t>(around.near_begin[p + 1] - around.near_begin[p]));
}

/// Everything about the bodies there; nothing is near yet.
Surroundings surroundings(const PreparedTissue& muscle, const std::vector<RigidTransform>& bodies,
                          const std::vector<CellLaw>& laws);

/// Of what follows a distance's values on a grid: along each axis by no more than the way.
inline constexpr Real largest_slope = 1.7320508075688772;

/// Points within this distance of touching a bone are near it, m: less than the margin of usual distance fields.
inline constexpr Real near_bones = 0.006;
/// Makes these planes those of other muscles. Precondition: in the order of points.
void set_planes(const PreparedTissue& muscle, std::vector<ContactPlane> planes, Surroundings& around);
/// Finds what is near: holds until a point has moved by `near_bones`.
void find_near_bones(const PreparedTissue& muscle, const Points& nodes, Surroundings& around);

/// Memory of `total_energy`, kept from one call to the next.
struct EnergyWorkspace {
  Points moved;          ///< nodes, from their places at rest, m
  Points point_forces;   ///< N
  CornerForces corners;  ///< N
};

/// All energy of a muscle (J) and its derivative by the nodes (3 × n, N). Infinite where a tetrahedron is inverted; the
/// gradient means nothing then. The same bits for any number of threads.
Real total_energy(const PreparedTissue& muscle, const Surroundings& around, const Points& nodes,
                  EnergyWorkspace& workspace, Points& gradient);

/// A third of the trace of every 3 × 3 block of the second derivatives at rest, in the capture pose: nodes × nodes,
/// N/m. Positive definite.
Eigen::SparseMatrix<Real> scalar_stiffness(const PreparedTissue& muscle, const std::vector<CellLaw>& laws);

/// Where a point is: rest plus what its cell has moved; all of them, 3 × points; and the surface's vertices alone.
Vec3 point_at(const PreparedTissue& muscle, const Points& nodes, Index point);
/// All points of the muscle, 3 × points, m (point_at).
Points points_at(const PreparedTissue& muscle, const Points& nodes);
/// The vertices of its surface alone, m (point_at).
Points surface_at(const PreparedTissue& muscle, const Points& nodes);

/// The least volume of a tetrahedron over that at rest.
Real least_volume_ratio(const Lattice& lattice, const Points& nodes);

}  // namespace gracilis::tissue
