#pragma once

#include <gracilis/core/types.hpp>

#include <vector>

namespace gracilis {

/// A force and its moment about the world's origin.
struct Wrench {
  Vec3 force = Vec3::Zero();   ///< N
  Vec3 moment = Vec3::Zero();  ///< N·m

  /// A force (N) that acts at a point (m from the one that the moment is about).
  void add(const Vec3& at, const Vec3& acting) {
    force += acting;
    moment += at.cross(acting);
  }
};

/// What a muscle does to one body or bone.
struct ForceOn {
  Index on = 0;
  Wrench wrench;
};

/// The forces of a muscle in equilibrium in one pose; without a tension of its fibers for methods that know none. What
/// is listed is the same in all poses.
struct MuscleForces {
  bool is_known = false;
  Real tension = 0;                                ///< N, of all fibers together, the mean over their length
  std::vector<Real> fiber_tensions;                ///< N, of each fiber, which stands for an equal share of the muscle
  std::vector<ForceOn> origin, insertion, fascia;  ///< on bodies, by attachments of either end and by fascia
  std::vector<ForceOn> contact;                    ///< on bones
  std::vector<ForceOn> muscles;                    ///< on other muscles
  /// Per coordinate, N·m per rad (of a translation N): what all that acts on bodies does in its motion, and the energy
  /// that the muscle loses in it while its inside moves along with the bodies. The two are equal at rest.
  std::vector<Real> moments, moments_by_work;
};

}  // namespace gracilis
