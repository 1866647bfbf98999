#include <gracilis/view/window/bone_pull.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/joints/joint_twists.hpp>

#include <algorithm>
#include <utility>

namespace gracilis {

bool pull_bone(const Scene& scene, std::size_t bone, const Vec3& point, const Vec3& target, const Vec3& looking,
               std::vector<Real>& coordinates) {
  const auto body = static_cast<std::size_t>(scene.bones[bone].body);
  std::vector<std::pair<std::size_t, const JointAxis*>> moved;  // coordinates of the joint
  std::size_t number = 0;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes) {
      if (static_cast<std::size_t>(joint.child_body) == body) moved.emplace_back(number, &axis);
      ++number;
    }
  if (moved.empty()) return false;
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - looking * looking.transpose();
  // A few damped steps of Gauss and Newton; without damping what hardly moves the point would turn far.
  constexpr int steps = 6;
  constexpr Real damping = 0.01;  // m per rad
  for (int step = 0; step < steps; ++step) {
    const Vec3 place = pose_at(scene, coordinates).bodies[body] * point;
    const std::vector<std::vector<Twist>> twists = joint_twists(scene, coordinates);
    Eigen::Matrix3Xd moves(3, static_cast<Index>(moved.size()));
    for (std::size_t i = 0; i < moved.size(); ++i)
      moves.col(static_cast<Index>(i)) = across * twists[moved[i].first][body].velocity_at(place);
    Eigen::MatrixXd normal = moves.transpose() * moves;
    normal.diagonal().array() += damping * damping;
    const Vec3 lacking = across * (target - place);
    const Eigen::VectorXd change = normal.ldlt().solve(moves.transpose() * lacking);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      Real& value = coordinates[moved[i].first];
      value = std::clamp(value + change[static_cast<Index>(i)], moved[i].second->range_min, moved[i].second->range_max);
    }
  }
  return true;
}

}  // namespace gracilis
