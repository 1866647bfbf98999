#include <gracilis/geometry/principal_axes.hpp>

#include <Eigen/Eigenvalues>

namespace gracilis {

PrincipalAxes principal_axes(const Eigen::Matrix3d& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

PrincipalAxes spread_of(const Points& points) {
  const Points around = points.colwise() - points.rowwise().mean();
  return principal_axes(around * around.transpose());
}

}  // namespace gracilis
