#include <gracilis/anatomy/joints/blended_bodies.hpp>

#include <gracilis/geometry/rigid_blend.hpp>

#include <algorithm>

namespace gracilis {

void place_by_bodies(const Scene& scene, Pose& pose) {
  for (const MuscleBody& each : scene.muscle_bodies) {
    std::vector<RigidTransform> motions;
    const Eigen::Translation3d center(each.center);
    for (const Index body : each.bodies)
      motions.push_back(center.inverse() * pose.bodies[static_cast<std::size_t>(body)] * center);
    if (motions.empty()) continue;
    const bool stays = std::all_of(motions.begin(), motions.end(),
                                   [](const RigidTransform& motion) { return motion.matrix().isIdentity(0); });
    pose.bodies[static_cast<std::size_t>(each.body)] =
        stays ? RigidTransform::Identity() : center * blend(prepare_blend(motions), each.shares) * center.inverse();
  }
}

void add_twists(const Scene& scene, std::vector<Twist>& of_bodies) {
  for (const MuscleBody& each : scene.muscle_bodies) {
    Twist mean;
    for (std::size_t b = 0; b < each.bodies.size(); ++b) {
      const Twist& twist = of_bodies[static_cast<std::size_t>(each.bodies[b])];
      mean.velocity += each.shares[b] * twist.velocity;
      mean.turning += each.shares[b] * twist.turning;
    }
    of_bodies[static_cast<std::size_t>(each.body)] = mean;
  }
}

}  // namespace gracilis
