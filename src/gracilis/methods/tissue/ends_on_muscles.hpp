#pragma once

#include <gracilis/anatomy/attachments/muscle_bodies.hpp>
#include <gracilis/methods/tissue/total_energy.hpp>

#include <vector>

/// Ends of muscles that lie on other muscles, which springs join them to.
namespace gracilis::tissue {

/// A point of the guest that it is held by, and its place at rest on the host.
struct JoinedPoint {
  Index point = 0;  ///< of PreparedTissue::points
  HostPlace place;
};

/// An end that lies on a muscle.
struct EndOnMuscle {
  std::size_t guest = 0, host = 0;
  CarriedBody body;
  std::vector<JoinedPoint> points;
};

/// All of a scene, hosts before their guests. `muscles` are those of the scene, prepared.
std::vector<EndOnMuscle> ends_on_muscles(const Scene& scene, const std::vector<PreparedTissue>& muscles);

/// The stiffness of the spring at a point of an end, N/m.
Real joint_stiffness(const PreparedTissue& guest, const JoinedPoint& joined);

/// Tells hosts how stiff the springs are that join their vertices to ends. `muscles` are those of the scene.
void prepare_joints(const std::vector<EndOnMuscle>& ends, std::vector<PreparedTissue>& muscles);

/// Groups of muscles that ends join, by way of others too; not those that nothing lies on and that lie on none.
std::vector<std::vector<std::size_t>> joined_groups(const std::vector<EndOnMuscle>& ends, std::size_t muscles);

/// How the patch below an end has turned since rest.
Matrix3 turn_of_patch(const EndOnMuscle& end, const Points& host_surface);

/// A muscle, and where its nodes are.
struct PlacedTissue {
  const PreparedTissue& muscle;
  const Points& nodes;

  Vec3 place(Index point) const { return point_at(muscle, nodes, point); }  ///< of one of its points, m
};

/// Holds the guest's points where the host's surface is.
void hold_on_host(const EndOnMuscle& end, const Matrix3& turn, const PlacedTissue& host, Surroundings& of_guest);

/// Draws the host's vertices to where the guest is, as it draws them: for what both do to each other in equilibrium.
/// `of_guest` holds it where the host is.
void draw_host(const EndOnMuscle& end, const PlacedTissue& guest, const PlacedTissue& host,
               const Surroundings& of_guest, Surroundings& of_host);

}  // namespace gracilis::tissue
