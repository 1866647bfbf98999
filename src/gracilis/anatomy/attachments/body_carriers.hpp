#pragma once

#include <gracilis/geometry/topology.hpp>
#include <gracilis/scene/pose.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// The bodies that carry a muscle's surface: one each for attached vertices, a blend of all for the others.
struct BodyCarriers {
  Vec3 center = Vec3::Zero();     ///< of the rest, about which motions are blended
  std::vector<Index> fixed_body;  ///< per vertex: the body it is attached to, or -1
  std::vector<Index> bodies;      ///< that the muscle is attached to, ascending
  Eigen::MatrixXf weights;        ///< bodies × vertices (anatomy/attachments/skinning_weights.hpp)
};

/// `tendon_length` in m, as in skinning_weights.
BodyCarriers body_carriers(const Muscle& muscle, const MeshTopology& topology, Real tendon_length);

/// Per vertex: whether it does not move by itself, because it is attached or because no attachment reaches it.
std::vector<char> held_vertices(const BodyCarriers& carriers);

/// How every vertex is carried from the capture pose to this one: exactly as its body where it is attached, by the
/// blend of the bodies' motions (geometry/rigid_blend.hpp) elsewhere; not at all where no attachment reaches it.
std::vector<RigidTransform> carried_motions(const BodyCarriers& carriers, const Pose& pose);
/// The same of the listed vertices alone, in their order.
std::vector<RigidTransform> carried_motions(const BodyCarriers& carriers, const Pose& pose,
                                            const std::vector<Index>& vertices);

/// Each point (m) by the motion of its number.
Points moved_by(const std::vector<RigidTransform>& motions, const Points& points);

/// A surface at pose `last`, carried on to pose `now`; attached vertices go where `rest` says. Returning to a pose
/// returns to the shape. 3 × n, m.
Points carried_on(const BodyCarriers& carriers, const Points& rest, const Pose& last, const Pose& now,
                  const Points& before);

}  // namespace gracilis
