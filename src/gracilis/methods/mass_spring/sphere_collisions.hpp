#pragma once

#include <gracilis/methods/mass_spring/relaxation.hpp>
#include <gracilis/methods/mass_spring/sphere_tree.hpp>

#include <array>
#include <memory>
#include <vector>

namespace gracilis::mass_spring {

/// A muscle's spheres about some of its particles.
struct MuscleSpheres {
  std::vector<Index> particles;  ///< per sphere
  Spheres rest;                  ///< in the capture pose
  std::vector<char> fixed;       ///< per sphere
  bool meets_bones = false;
  bool keeps_rest_gap = false;  ///< pairs come as near to each other as in the capture pose
};

/// A bone's spheres.
struct PlacedSpheres {
  Spheres rest;                                        ///< in the capture pose
  RigidTransform motion = RigidTransform::Identity();  ///< from there to where the bone is now
};

/// Where two spheres go that intersect, m: apart along the line between their centers, by half of what is missing each,
/// or, where one of them is fixed, by all of it the other (Janák 2012, section 4.3). Zero where they are `reach` or
/// more apart, where both are fixed, and where their centers coincide, so that nothing tells the way.
struct Response {
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
};
/// Of spheres with centers at a and b, m; `reach` is the sum of their radii.
Response response(const Vec3& a, const Vec3& b, Real reach, bool a_is_fixed, bool b_is_fixed);

/// All pairs of `count` players in rounds, each of whom is in one pair of a round at most (the circle method of
/// tournaments): pairs of a round can meet at the same time, and the order in which a player meets the others is given.
std::vector<std::vector<std::array<std::size_t, 2>>> rounds_of_pairs(std::size_t count);

/// Keeps the spheres of muscles out of each other and out of bones, in one pose.
class SphereCollisions {
 public:
  /// `muscles` must outlive this. Without `between_muscles` they keep out of bones alone.
  SphereCollisions(const std::vector<MuscleSpheres>& muscles, const std::vector<PlacedSpheres>& bones,
                   bool between_muscles, TreeUpdate update);

  /// Moves particles by the sum of all that their collisions ask for, as they lie before any is answered, and stops
  /// them. Returns the number of collisions of each muscle.
  std::vector<Index> resolve(std::vector<RelaxedMuscle>& muscles);

 private:
  struct Placed {
    Spheres now, rest;
    std::unique_ptr<SphereTree> tree;
  };
  struct Answer {
    Points shifts;  ///< m, per sphere
    std::vector<char> is_hit;
    Index collisions = 0;
  };

  void meet(std::size_t a, std::size_t b);
  void meet_muscles(std::size_t m, std::size_t n);
  void meet_bone(std::size_t m, Placed& bone);
  void answer(std::size_t m, Motion& motion) const;

  const std::vector<MuscleSpheres>& muscles_;
  bool between_muscles_;
  std::vector<std::unique_ptr<Placed>> placed_, bones_;
  std::vector<Answer> answers_;
  std::vector<std::vector<std::array<std::size_t, 2>>> rounds_;  ///< of muscles, then bones
};

}  // namespace gracilis::mass_spring
