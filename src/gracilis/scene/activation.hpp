#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/scene/pose.hpp>

#include <functional>
#include <string>
#include <vector>

/// How active muscles are: 0 relaxed, 1 as active as can be. Each muscle is driven in one of three ways at most; one
/// that nothing drives stays relaxed.
namespace gracilis {

/// An activation over time, linear between its rows and constant before and after them; a single row is a constant.
struct ActivationSignal {
  std::string muscle;
  std::vector<Real> times;   ///< s, increasing
  std::vector<Real> values;  ///< one per time
};

/// What a joint knows of the activations of the muscles that cross it: samples of poses with the activations that went
/// with them (the joint control unit of Kohout and colleagues). Evaluated by anatomy/joints/joint_control.hpp.
struct JointControlUnit {
  std::string name;
  std::string joint;                     ///< the joint it belongs to, which gives the moving body and the center
  std::vector<std::string> coordinates;  ///< that the samples tell apart, of this joint or of several
  std::vector<std::string> muscles;      ///< that it governs
  Eigen::MatrixXd angles;                ///< samples × coordinates, rad
  Eigen::MatrixXd activations;           ///< samples × muscles
  Real falloff = 0;                      ///< 1/deg², F in exp(-F d²); 0: from the spacing of the samples
  int neighbors = 10;                    ///< K, how many samples are asked
  Real hit_distance = radians(1e-6);     ///< rad, ε: a sample nearer than this is the answer
};

/// An activation that follows from the pose.
struct ActivationOfPose {
  std::string muscle;
  std::function<Real(const Pose&)> value;
};

/// All that drives the muscles of a scene.
struct ActivationPlan {
  std::vector<ActivationSignal> signals;
  std::vector<JointControlUnit> units;
  std::vector<ActivationOfPose> functions;

  bool empty() const { return signals.empty() && units.empty() && functions.empty(); }  ///< says nothing of any muscle
};

/// True when the plan says how active this muscle is.
bool drives(const ActivationPlan& plan, const std::string& muscle);

}  // namespace gracilis
