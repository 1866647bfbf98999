#pragma once

#include <gracilis/opensim/kinematics/skeleton.hpp>

#include <optional>
#include <string>

namespace gracilis::opensim {

/// The coordinates that neither couplers nor locks set, nor those that are `held`.
std::vector<Eigen::Index> free_coordinates(const Model& model, const std::vector<bool>& held = {});

/// What became of a pose whose loops were to be closed.
struct LoopClosure {
  Real open = 0;          ///< m or rad, the largest that stays open
  Real moved = 0;         ///< rad or m, the most that a held coordinate had to give way
  Index coordinate = -1;  ///< that one
};

/// Sets what depends on others: coordinates of couplers, and those of closed loops. Of a model without loops the
/// couplers alone.
class LoopCloser {
 public:
  /// Keeps a reference to the model.
  explicit LoopCloser(const Model& model);

  /// Moves the coordinates that are not held as little as possible (in the sum of squares, rad and m alike) so that
  /// loops close: by Newton's method from the coordinates given. Where that cannot be, held ones give way, too. Locked
  /// coordinates stay.
  LoopClosure close(Eigen::VectorXd& coordinates, const std::vector<bool>& held);

 private:
  Real close_with(Eigen::VectorXd& coordinates, const std::vector<Eigen::Index>& free);

  const Model& model_;
  std::optional<Skeleton> skeleton_;
};

/// Slopes of the loops' errors (Skeleton::loop_slopes) with each coordinate when couplers set the dependent ones.
Eigen::MatrixXd independent_loop_slopes(const Skeleton& skeleton, const Eigen::VectorXd& coordinates);

/// The motions that a model can make as placed: orthonormal columns of rates of its coordinates that neither couplers
/// nor locks set, which keep its loops closed. Without loops a column for each such coordinate.
Eigen::MatrixXd free_motions(const Skeleton& skeleton, const Eigen::VectorXd& coordinates);

/// Arms about each coordinate when loops make others go along, as little as they let them; as OpenSim's moment arms
/// are.
Eigen::VectorXd arms_through_loops(const Eigen::MatrixXd& free_motions, const Eigen::VectorXd& arms);

/// Closes the loops of the model's default pose, with these coordinates held; OpenSim does the same when it loads a
/// model.
LoopClosure assemble_defaults(Model& model, const std::vector<bool>& held = {});

/// Loops that are open by more stay so, m or rad.
inline constexpr Real closed_loop = 1e-5;

/// Says of the model's default pose that its loops stay open; empty where they close.
std::string open_loops_note(const Model& model, const LoopClosure& closure);

}  // namespace gracilis::opensim
