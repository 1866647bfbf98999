#include <gracilis/strings/coupled_solver.hpp>

#include <Eigen/LU>
#include <Eigen/QR>

namespace gracilis::strings {

namespace {

/// Relative residual that is left: of motions, whose arms it moves by micrometres, and of weights, from which forces
/// come that have to balance; and how many directions are tried for it.
constexpr Real motion_tolerance = 1e-4, weight_tolerance = 1e-5;
constexpr Index most_directions = 40;

}  // namespace

CoupledSolver::CoupledSolver(const MuscleStrings& muscle, const ForceRates& rates, const std::vector<char>& left_out)
    : muscle_(muscle), rates_(rates), left_out_(left_out) {
  inverse_.assign(rates.here().size(), Eigen::Matrix3d::Zero());
  upper_ = inverse_;
  stable_.assign(static_cast<std::size_t>(muscle.strings), 1);
  for (Index s = 0; s < muscle.strings; ++s)
    for (Index i = 1; i + 1 < muscle.nodes; ++i) {
      if (!moves_freely(s, i)) continue;
      const auto row = static_cast<std::size_t>(muscle.node(s, i));
      const Eigen::Matrix3d pivot = rates.here()[row] - rates.before()[row] * upper_[row - 1];
      if (!(pivot.determinant() > 0)) stable_[static_cast<std::size_t>(s)] = 0;
      inverse_[row] = pivot.inverse();
      if (body_holding(muscle, s, i + 1) < 0) upper_[row] = inverse_[row] * rates.after()[row];
    }
}

Points CoupledSolver::free_part(Points columns) const {
  for (Index s = 0; s < muscle_.strings; ++s)
    for (Index i = 0; i < muscle_.nodes; ++i)
      if (!moves_freely(s, i)) columns.col(muscle_.node(s, i)).setZero();
  return columns;
}

Points CoupledSolver::own_moves(Points forces) const {
  for (Index s = 0; s < muscle_.strings; ++s) {
    for (Index i = 1; i + 1 < muscle_.nodes; ++i) {
      const Index p = muscle_.node(s, i);
      const auto row = static_cast<std::size_t>(p);
      // Nodes that are not free have no pivot, and are zero.
      forces.col(p) = (inverse_[row] * (forces.col(p) - rates_.before()[row] * forces.col(p - 1))).eval();
    }
    for (Index i = muscle_.nodes - 2; i > 0; --i) {
      const Index p = muscle_.node(s, i);
      forces.col(p) -= upper_[static_cast<std::size_t>(p)] * forces.col(p + 1);
    }
  }
  return forces;
}

Points CoupledSolver::own_transposed(Points weights) const {
  for (Index s = 0; s < muscle_.strings; ++s) {
    for (Index i = 1; i + 1 < muscle_.nodes; ++i) {
      const Index p = muscle_.node(s, i);
      weights.col(p) -= upper_[static_cast<std::size_t>(p - 1)].transpose() * weights.col(p - 1);
    }
    for (Index i = muscle_.nodes - 2; i > 0; --i) {
      const Index p = muscle_.node(s, i);
      const auto row = static_cast<std::size_t>(p);
      weights.col(p) =
          (inverse_[row].transpose() * (weights.col(p) - rates_.before()[row + 1].transpose() * weights.col(p + 1)))
              .eval();
    }
  }
  return weights;
}

template <class Operator>
Points CoupledSolver::solved(const Operator& preconditioned, const Points& right, Real tolerance) const {
  const Eigen::VectorXd begin = right.reshaped();
  const Real length = begin.norm();
  if (!(length > 0) || !right.allFinite()) return Points::Zero(3, right.cols());
  std::vector<Eigen::VectorXd> directions = {begin / length};
  Eigen::MatrixXd hessenberg = Eigen::MatrixXd::Zero(most_directions + 1, most_directions);
  Eigen::VectorXd shares;
  for (Index k = 0; k < most_directions; ++k) {
    const Points last = directions.back().reshaped(3, right.cols());
    Eigen::VectorXd next = preconditioned(last).reshaped();
    for (Index j = 0; j <= k; ++j) {
      hessenberg(j, k) = next.dot(directions[static_cast<std::size_t>(j)]);
      next -= hessenberg(j, k) * directions[static_cast<std::size_t>(j)];
    }
    hessenberg(k + 1, k) = next.norm();
    const Eigen::MatrixXd small = hessenberg.topLeftCorner(k + 2, k + 1);
    const Eigen::VectorXd aim = length * Eigen::VectorXd::Unit(k + 2, 0);
    shares = small.colPivHouseholderQr().solve(aim);
    if ((small * shares - aim).norm() <= tolerance * length || !(hessenberg(k + 1, k) > 0)) break;
    directions.push_back(next / hessenberg(k + 1, k));
  }
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(begin.size());
  for (Index k = 0; k < shares.size(); ++k) sum += shares[k] * directions[static_cast<std::size_t>(k)];
  return sum.reshaped(3, right.cols());
}

Points CoupledSolver::moves(const Points& forces) const {
  const auto preconditioned = [&](const Points& rates) { return own_moves(rates_.by_places(rates)); };
  return solved(preconditioned, own_moves(forces), motion_tolerance);
}

Points CoupledSolver::transposed(const Points& weights) const {
  const auto preconditioned = [&](const Points& of_forces) {
    return own_transposed(free_part(rates_.by_places_transposed(of_forces)));
  };
  return solved(preconditioned, own_transposed(free_part(weights)), weight_tolerance);
}

}  // namespace gracilis::strings
