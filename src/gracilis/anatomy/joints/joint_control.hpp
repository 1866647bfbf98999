#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/scene/activation.hpp>
#include <gracilis/scene/scene.hpp>

#include <memory>
#include <vector>

namespace gracilis {

/// A joint control unit ready for queries. The activations at joint angles q are the mean of those of the nearest
/// samples (K, or all when there are fewer), with the weights \f$e^{-F d^2}\f$, d the distance of the angles in
/// degrees, made to sum to 1. A sample no farther than ε from q is returned as it is; where all weights underflow, the
/// nearest sample is.
class JointControl {
 public:
  /// Precondition: the unit has samples and as many columns as names. Of samples with the same angles the mean counts.
  explicit JointControl(const JointControlUnit& unit);
  ~JointControl();
  /// One that is moved from may only be assigned to or destroyed.
  JointControl(JointControl&&) noexcept;
  JointControl& operator=(JointControl&&) noexcept;  ///< as the constructor

  /// Activations of the governed muscles, in the unit's order, at angles (rad) in the order of the unit's coordinates.
  Eigen::VectorXd at(const Eigen::VectorXd& angles) const;

  /// The samples that are asked there, nearest first, as rows of angles_deg(); one where it is hit.
  std::vector<Index> neighbors(const Eigen::VectorXd& angles) const;
  /// The samples' angles, one per row, degrees; those of the same angles are one.
  const Eigen::MatrixXd& angles_deg() const;

  /// F, 1/deg².
  Real falloff() const { return falloff_; }
  Index sample_count() const;  ///< those of the same angles are one

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
  Real falloff_, hit_deg_;
  std::size_t neighbors_;
};

/// The falloff that suits samples (rows, degrees): \f$1 / (2 s^2)\f$, s the median distance of a sample to its nearest
/// other one; 1 when there is none.
Real falloff_for(const Eigen::MatrixXd& samples_deg);

/// How well a unit interpolates: per muscle the root mean square difference between the activations of every second
/// sample and what the unit says there when it knows the others only. Zeros when there are fewer than three samples.
Eigen::VectorXd leave_out_error(const JointControlUnit& unit);

/// The body that the unit's joint moves and the joint's center, in the capture pose.
struct MovingBody {
  Index body = -1;
  Vec3 center = Vec3::Zero();
};
/// Body -1 and a zero center where the scene has no joint of the unit's name.
MovingBody moving_body(const Scene& scene, const JointControlUnit& unit);

}  // namespace gracilis
