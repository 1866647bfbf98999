#pragma once

#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/methods/rbf/muscle_model.hpp>

#include <functional>
#include <vector>

namespace gracilis::rbf {

/// A muscle's surface that follows its centers.
struct FollowedSurface {
  TriangleMesh rest;  ///< world, in the capture pose, m
  VertexStars stars;
  std::vector<char> held;   ///< per vertex: attached, or out of every attachment's reach
  Eigen::VectorXd freedom;  ///< per vertex: how much of an offset it takes, 0 on held ones, 1 far from them
  Real volume = 0;          ///< m³
};

/// Of a muscle's surface in the capture pose, with its topology and what bodies carry of it.
FollowedSurface followed_surface(const TriangleMesh& mesh, const MeshTopology& topology, const BodyCarriers& carriers);

/// What the surface is asked for beside its level.
struct FollowRequests {
  bool keeps_volume = true;
  std::function<Index(Points&)> push_out;  ///< out of bones; says how many it pushed; none: it is not asked
};

struct Followed {
  Points points;
  Index contacts = 0;
  Real offset = 0;  ///< m, by which levels were moved
};

/// By how much a vertex is moved where centers are moved by `corrections`, m.
Vec3 correction_at(const MuscleModel& model, Index vertex, const Points& corrections);

/// Where the vertices are: carried, moved as the centers are by `corrections` (to where they are in `basis`), then
/// along the gradient to their level (plus the offset that restores the volume), and out of bones.
Followed follow(const FollowedSurface& surface, const MuscleModel& model, const std::vector<RigidTransform>& motions,
                const Points& corrections, const RadialBasis& basis, const FollowRequests& requests);

}  // namespace gracilis::rbf
