#include <gracilis/geometry/rotations.hpp>

#include <Eigen/SVD>

namespace gracilis {

Eigen::Quaterniond turn_from_to(const Vec3& from, const Vec3& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  // The direction that matters least turns around.
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) = -u.col(2);
  return u * svd.matrixV().transpose();
}

RigidTransform rigid_motion(const Points& from, const Points& to) {
  RigidTransform motion = RigidTransform::Identity();
  if (from != to) motion.matrix() = Eigen::umeyama(from, to, false);
  return motion;
}

}  // namespace gracilis
