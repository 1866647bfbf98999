#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <memory>
#include <vector>

namespace gracilis::opensim {

/// Torque about the body's origin (rows 0 to 2) and force (rows 3 to 5) on each body (columns), in the ground's axes.
using BodyForces = Eigen::Matrix<Real, 6, Eigen::Dynamic>;

/// Adds a force that acts at a point of the ground frame on a body at `pose`.
void add_force(BodyForces& forces, Index body, const RigidTransform& pose, const Vec3& point, const Vec3& force);

/// Forces on bodies and, beside these, on coordinates themselves (N·m or N, per coordinate).
struct AppliedForces {
  BodyForces bodies;
  Eigen::VectorXd coordinates;
  /// None, with room for the model's bodies and coordinates.
  explicit AppliedForces(const Model& model);
  /// `others` times a factor; of the same model.
  void add(const AppliedForces& others, Real times = 1);
};

/// A model's bodies and joints as a multibody tree of Simbody (Sherman, Seth, Delp 2011): kinematics and inverse
/// dynamics. Couplers and loops are kept by the caller: see apply_couplers, onto_independent and LoopCloser.
/// Coordinates are ordered as in Model::coordinates; speeds are their time derivatives.
class Skeleton {
 public:
  /// Keeps a reference to the model. Throws InputError where Simbody refuses it.
  explicit Skeleton(const Model& model);
  ~Skeleton();
  Skeleton(const Skeleton&) = delete;
  Skeleton& operator=(const Skeleton&) = delete;

  const Model& model() const;  ///< that it was made of

  /// Puts the bodies where the coordinates say (rad, m).
  void place(const Eigen::VectorXd& coordinates);
  /// Where the bodies are, in the ground frame; the ground itself first.
  const std::vector<RigidTransform>& poses() const;

  /// Generalized forces (N·m for angles, N for lengths) of forces on the bodies as placed: the virtual work per change
  /// of each coordinate.
  Eigen::VectorXd generalized_forces(const BodyForces& forces) const;
  /// The same with what acts on coordinates themselves.
  Eigen::VectorXd generalized_forces(const AppliedForces& forces) const;

  /// Generalized forces that the joints must give, beside gravity and `applied`, for the bodies as placed to move with
  /// these speeds and accelerations.
  Eigen::VectorXd inverse_dynamics(const Eigen::VectorXd& speeds, const Eigen::VectorXd& accelerations,
                                   const BodyForces& applied) const;
  /// The same, body by body: what each needs beside gravity and `applied`, about its origin.
  BodyForces needed_on_bodies(const Eigen::VectorXd& speeds, const Eigen::VectorXd& accelerations,
                              const BodyForces& applied) const;

  /// By how much the model's loops are open as placed (m, rad; several numbers each), and how that changes with each
  /// coordinate: numbers × coordinates.
  Eigen::VectorXd loop_errors() const;
  /// How loop_errors change: numbers × coordinates.
  Eigen::MatrixXd loop_slopes() const;
  /// What closes the loops pulls on bodies with, for a multiplier per number of loop_errors: their generalized forces
  /// are loop_slopes().transpose() times multipliers.
  BodyForces loop_forces(const Eigen::VectorXd& multipliers) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// Generalized forces per independent coordinate: a dependent one's force works through the coupler's slope. Entries of
/// dependent coordinates become zero.
Eigen::VectorXd onto_independent(const Model& model, const Eigen::VectorXd& coordinates, Eigen::VectorXd forces);

}  // namespace gracilis::opensim
