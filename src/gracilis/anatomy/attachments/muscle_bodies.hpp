#pragma once

#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/scene/pose.hpp>
#include <gracilis/scene/scene.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

/// Ends of muscles that lie on other muscles: bodies that muscles carry. All points in m, in the world frame.
namespace gracilis {

/// Adds a body that a muscle of the scene carries, for what is attached at these points on it or beside it; its index.
/// It moves with the vertices within a few edges of the points. Preconditions: there is a point, the muscle has
/// triangles and all its attachments, and they lie on no muscle that hangs on this body.
Index add_muscle_body(Scene& scene, const std::string& name, Index muscle, const Points& points);

/// Where a point lies on a muscle or beside it.
struct HostPlace {
  std::array<Index, 3> corners = {};  ///< of the nearest triangle
  Vec3 weights = Vec3::Zero();        ///< of the corners, sum 1
  Vec3 offset = Vec3::Zero();         ///< m, from there to the point; turns with the patch
};
/// Of a point (m) by the nearest triangle; `faces` are those of the host.
HostPlace host_place(const NearestTriangle& host, const Eigen::Matrix3Xi& faces, const Vec3& point);

/// The muscles in groups: whose ends lie on no other first, then those that lie on these, and so on.
std::vector<std::vector<std::size_t>> hosts_first(const Scene& scene);

/// A body that a muscle carries, and what of the muscle it moves with, in whatever numbering of its vertices.
struct CarriedBody {
  Index body = 0;
  Index muscle = 0;
  std::vector<Index> patch;
  Points rest;  ///< of the patch
};

/// All of a scene, in the scene's order and numbering: those that a muscle carries before those that its guests do.
std::vector<CarriedBody> carried_bodies(const Scene& scene);

/// How a body has moved since rest, by the muscle's vertices: the rigid motion nearest to that of its patch.
RigidTransform motion_of(const CarriedBody& body, const Points& vertices);

/// Puts what these muscles carry where they are. `shape`
/// gives a muscle's vertices, or null: what it carries stays where the pose says.
void place_carried_bodies(const std::vector<CarriedBody>& bodies, const std::vector<std::size_t>& muscles,
                          const std::function<const Points*(std::size_t muscle)>& shape, Pose& pose);

}  // namespace gracilis
