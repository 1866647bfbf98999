#pragma once

#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/scene/frame.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/simulate/place_beside_way.hpp>
#include <gracilis/simulate/shape_now.hpp>
#include <gracilis/simulate/taut_way.hpp>

#include <optional>
#include <vector>

namespace gracilis {

/// How far every vertex is on the way from origin to insertion over the surface, 0 to 1: its distance along edges from
/// the origin over the sum of both distances. NaN where a muscle lacks one of them.
Eigen::VectorXd share_of_way(const Muscle& muscle);

/// How far muscles' bellies have come off what they lay on in the capture pose.
///
/// Of each muscle at most 160 vertices between a third and two thirds of the way from origin to insertion are looked
/// at. One that is no further than 10 mm from a bone or another muscle in the capture pose lies on them; where less
/// than a tenth of the belly's surface does, as where other muscles are not in the scene, the nearest tenth does, on
/// what is nearest.
class BellyPlace {
 public:
  /// The scene, the distances to its bones and the ways, which are those of the capture pose here, must outlive this.
  BellyPlace(const Scene& scene, const std::vector<SignedDistance>& bones, const TautWays& ways);

  /// Per muscle the mean over those vertices, by area, of how much further they are than at rest from the nearest of
  /// the other muscles that they lay on and the bones that any of them lay on, m; what is nearer counts as 0. A belly
  /// may slide along them, and touch others in one place that it touched in another. No vertex counts for more than it
  /// has moved against the bone that was nearest to it: what stays is not off because others have left it. Nor does one
  /// count for more than it is from where the nearest of the muscle's taut ways has taken it: what tension pulls
  /// straight between its ends is in its place.
  /// `length_ratios` is per muscle the length of its fibers over that at rest: a muscle that becomes shorter becomes
  /// thicker, by one over its root, and a vertex may be further from its ground by as much. 0 for muscles without
  /// origin or insertion. The ways are those of the frame's pose. Deterministic.
  std::vector<Real> off_place(const Frame& frame, const std::vector<Real>& length_ratios) const;

 private:
  /// A vertex that lies on something.
  struct Contact {
    Index vertex = 0;
    Real area = 0;                   ///< m²
    Real rest_gap = 0;               ///< m, from the nearest of what it lies on
    std::vector<std::size_t> bones;  ///< that it lies on
    std::vector<std::size_t> muscles;
    std::optional<std::size_t> carrier;  ///< the nearest bone
    std::optional<PlaceBesideWay> place;
  };
  /// Where bones and muscles are in a frame.
  struct Surroundings {
    std::vector<RigidTransform> to_local;         ///< per bone
    std::vector<std::optional<ShapeNow>> shapes;  ///< of the muscles that are asked for
  };

  Surroundings surroundings(const Frame& frame, const std::vector<char>& asked) const;
  std::vector<Contact> contacts_of(std::size_t muscle, const Surroundings& rest) const;
  std::optional<std::size_t> nearest_bone(const Vec3& p) const;
  Real moved(std::size_t muscle, const Contact& contact, const Surroundings& around, const Vec3& p) const;
  Real off_way(std::size_t muscle, const Contact& contact, const Vec3& p, Real thickening) const;
  Real bone_gap(std::size_t bone, const Surroundings& around, const Vec3& p, Real reach) const;
  Real gap(std::size_t muscle, const Contact& contact, const Surroundings& around, const Vec3& p) const;

  const Scene& scene_;
  const std::vector<SignedDistance>& bones_;
  const TautWays& ways_;
  std::vector<FacesAround> around_;                ///< per muscle
  std::vector<std::vector<Contact>> contacts_;     ///< per muscle
  std::vector<std::vector<std::size_t>> grounds_;  ///< per muscle: the bones that any of its contacts lies on
  std::vector<char> asked_;                        ///< muscles that another lies on
};

}  // namespace gracilis
