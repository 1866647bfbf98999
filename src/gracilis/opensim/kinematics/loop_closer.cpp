#include <gracilis/opensim/kinematics/loop_closer.hpp>

#include <fmt/format.h>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

static constexpr Real closed = 1e-9;  // m, rad

LoopCloser::LoopCloser(const Model& model) : model_(model) {
  if (!model.loops.empty()) skeleton_.emplace(model);
}

std::vector<Eigen::Index> free_coordinates(const Model& model, const std::vector<bool>& held) {
  std::vector<Eigen::Index> free;
  for (std::size_t i = 0; i < model.coordinates.size(); ++i)
    if (!(i < held.size() && held[i]) && !model.coordinates[i].locked && !is_dependent(model, static_cast<Index>(i)))
      free.push_back(static_cast<Eigen::Index>(i));
  return free;
}

Eigen::MatrixXd independent_loop_slopes(const Skeleton& skeleton, const Eigen::VectorXd& coordinates) {
  Eigen::MatrixXd slopes = skeleton.loop_slopes();
  for (Eigen::Index row = 0; row < slopes.rows(); ++row)
    slopes.row(row) = onto_independent(skeleton.model(), coordinates, slopes.row(row));
  return slopes;
}

/// Loops may say the same twice.
static Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposed(const Eigen::MatrixXd& slopes) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(1e-9);
  solver.compute(slopes);
  return solver;
}

/// The nearest closed pose: of all steps that close the linearized loops the one that ends nearest to the start.
Real LoopCloser::close_with(Eigen::VectorXd& coordinates, const std::vector<Eigen::Index>& free) {
  const Real largest_step = 0.3;
  const Eigen::VectorXd start = coordinates(free);
  Real open = 0;
  for (int i = 0; i < 200; ++i) {
    apply_couplers(model_, coordinates);
    skeleton_->place(coordinates);
    const Eigen::VectorXd errors = skeleton_->loop_errors();
    open = errors.lpNorm<Eigen::Infinity>();
    if (free.empty()) break;
    const Eigen::MatrixXd slopes = independent_loop_slopes(*skeleton_, coordinates)(Eigen::all, free);
    const auto solver = decomposed(slopes);
    const Eigen::VectorXd here = coordinates(free);
    Eigen::VectorXd step = start + solver.solve(slopes * (here - start) - errors) - here;
    const Real size = step.lpNorm<Eigen::Infinity>();
    if (open < closed && size < 1e-9) break;
    if (size > largest_step) step *= largest_step / size;
    coordinates(free) = here + step;
  }
  return open;
}

LoopClosure LoopCloser::close(Eigen::VectorXd& coordinates, const std::vector<bool>& held) {
  apply_couplers(model_, coordinates);
  if (!skeleton_) return {};
  const Eigen::VectorXd wished = coordinates;
  LoopClosure closure;
  closure.open = close_with(coordinates, free_coordinates(model_, held));
  if (closure.open < 1e-7) return closure;
  coordinates = wished;
  closure.open = close_with(coordinates, free_coordinates(model_));
  for (std::size_t i = 0; i < held.size(); ++i) {
    const Real moved = std::abs(coordinates[static_cast<Eigen::Index>(i)] - wished[static_cast<Eigen::Index>(i)]);
    if (!held[i] || moved <= closure.moved) continue;
    closure.moved = moved;
    closure.coordinate = static_cast<Index>(i);
  }
  return closure;
}

Eigen::MatrixXd free_motions(const Skeleton& skeleton, const Eigen::VectorXd& coordinates) {
  const Model& model = skeleton.model();
  const std::vector<Eigen::Index> free = free_coordinates(model);
  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd motions = Eigen::MatrixXd::Identity(count, count);
  if (!model.loops.empty()) {
    const auto solver = decomposed(independent_loop_slopes(skeleton, coordinates)(Eigen::all, free));
    const Eigen::MatrixXd turned = solver.matrixZ().transpose();
    motions = solver.colsPermutation() * turned.rightCols(count - solver.rank());
  }
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(coordinates.size(), motions.cols());
  for (Eigen::Index i = 0; i < count; ++i) all.row(free[static_cast<std::size_t>(i)]) = motions.row(i);
  return all;
}

Eigen::VectorXd arms_through_loops(const Eigen::MatrixXd& motions, const Eigen::VectorXd& arms) {
  const Eigen::VectorXd along = motions * (motions.transpose() * arms);
  const Eigen::VectorXd own = motions.rowwise().squaredNorm();
  return (own.array() > 1e-9).select(along.cwiseQuotient(own.cwiseMax(1e-9)), 0);
}

LoopClosure assemble_defaults(Model& model, const std::vector<bool>& held) {
  if (model.loops.empty()) return {};
  Eigen::VectorXd coordinates = default_coordinates(model);
  const LoopClosure closure = LoopCloser(model).close(coordinates, held);
  for (std::size_t i = 0; i < model.coordinates.size(); ++i)
    model.coordinates[i].default_value = coordinates[static_cast<Eigen::Index>(i)];
  return closure;
}

std::string open_loops_note(const Model& model, const LoopClosure& closure) {
  if (!(closure.open > closed_loop)) return {};
  return fmt::format("{}: its loops stay open by {:.3g} (m or rad) in its default pose", model.name, closure.open);
}

}  // namespace gracilis::opensim
