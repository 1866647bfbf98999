#pragma once

#include <gracilis/opensim/kinematics/skeleton.hpp>
#include <gracilis/opensim/static_optimization/muscle_state.hpp>

#include <string>
#include <vector>

namespace gracilis::opensim {

/// Muscles and actuators of a model that apply force, muscles first. Points into the model.
struct ActiveForces {
  std::vector<const Muscle*> muscles;
  std::vector<const Actuator*> actuators;
  /// Those of the model; it must outlive this.
  explicit ActiveForces(const Model& model);
  Eigen::Index count() const { return static_cast<Eigen::Index>(muscles.size() + actuators.size()); }  ///< of both
  std::vector<std::string> names() const;  ///< in this order
};

/// What one newton (N·m) of an actuator does.
AppliedForces unit_effect(const Skeleton& skeleton, const Actuator& actuator);

/// Muscles and actuators at an instant, in the order of ActiveForces.
struct InstantForces {
  Eigen::VectorXd lengths, speeds;  ///< of muscles' paths, m and m/s
  Eigen::MatrixXd effects;          ///< of one newton (N·m) on each coordinate: coordinates × forces
};

/// For the skeleton as placed at these coordinates. What is done to dependent coordinates is taken into others.
InstantForces instant_forces(const Skeleton& skeleton, const ActiveForces& active, const Eigen::VectorXd& coordinates,
                             const Eigen::VectorXd& speeds);

/// Forces (N, N·m) at these activations, and how they grow with each one's own.
struct Strengths {
  Eigen::VectorXd forces, slopes;
  Eigen::VectorXd fiber_lengths;  ///< m, of muscles; empty where activation alone makes the force
};

/// `physiology`: forces depend on length and speed; otherwise on activation alone.
Strengths strengths(const ActiveForces& active, const InstantForces& instant, const Eigen::VectorXd& activations,
                    MuscleForces kind, bool physiology);

}  // namespace gracilis::opensim
