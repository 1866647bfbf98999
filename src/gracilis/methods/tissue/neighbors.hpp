#pragma once

#include <gracilis/dynamics/contact/surface/contact_world.hpp>
#include <gracilis/methods/tissue/preparation.hpp>

#include <vector>

namespace gracilis::tissue {

/// Keeps a point of a muscle on its side of a plane that lies midway between it and another muscle's surface.
struct ContactPlane {
  Index point = 0;             ///< of the muscle
  Index muscle = 0;            ///< the other one; -1: another part of its own surface
  Vec3 normal = Vec3::Zero();  ///< unit, away from the other
  Real least = 0;              ///< m: normal · place is no less
  /// m, of that: so much less, and the surfaces touch. Infinite where the point's own surface does not face the other.
  Real spare = 0;
  Real share = 1;  ///< of the stiffness that the muscle's surface has: what evens out the forces of two muscles
};

/// Two muscles that keep out of each other, each vertex by its gap: `neighbor_gap`, or that in the capture pose where
/// it is smaller, and below zero where they overlap there.
struct NeighborPair {
  Index first = 0, second = 0;
  std::vector<Real> first_gaps, second_gaps;  ///< m, per vertex
  Real widest = 0;                            ///< m, of the gaps, whether apart or deep
  Real deepest_seen = 0;     ///< m, how deep free vertices lay in the other at most when they last looked, or less ...
  bool lies_deeper = false;  ///< ... and any of them deeper than the two do around it at rest
};

/// How parts of one surface that fold onto each other keep apart.
struct SelfMeeting {
  Index muscle = 0;
  Particles rest;
  Eigen::Matrix3Xf rest_points, rest_normals;
  float neighborhood = 0;            ///< m, see SelfRule
  std::vector<Real> gaps;            ///< m, per vertex
  std::vector<ContactPlane> planes;  ///< as last found
};

/// The surfaces of all muscles for each other; constant but for the trees, which are fitted anew in each
/// search, how deep pairs were seen in each other, and planes of muscles that meet themselves.
struct Neighbors {
  ContactWorld world;  ///< surfaces, at rest, and how deep each of `pairs` lies in each other there
  std::vector<PatchTree> trees;
  std::vector<Eigen::VectorXd> areas;  ///< m² at rest, that each vertex stands for; 0 of attached ones
  std::vector<Real> stiffness;         ///< N/m³, per muscle
  std::vector<NeighborPair> pairs;
  std::vector<SelfMeeting> selves;  ///< of muscles that keep out of themselves

  bool none() const { return pairs.empty() && selves.empty(); }  ///< nothing meets anything
};

/// How far apart muscles see each other at most, m: what they move in a step is less.
inline constexpr Real neighbor_reach = 0.012;
/// The same of parts of one muscle, m: they move together.
inline constexpr Real self_reach = 0.006;

/// What a muscle asks of contact with muscles.
struct MeetingSettings {
  Real gap = 0;        ///< m, that its vertices keep
  Real stiffness = 0;  ///< N/m³
  bool self = false;   ///< also to itself
};
/// Of a scene's muscles in the capture pose; one of `settings` per muscle.
Neighbors prepare_neighbors(const Scene& scene, const std::vector<MeetingSettings>& settings);

/// Whether muscles look at themselves anew, or keep the planes that they found when they last did.
enum class SelfLook { anew, kept };

/// What planes are found for.
struct Look {
  SelfLook self = SelfLook::anew;
  /// m: no vertex moves further until planes are found anew. Two muscles that are further apart than both move cannot
  /// meet, and are not looked for.
  Real largest_move = neighbor_reach;
};

/// The planes of every muscle, in the order of its points, where the surfaces are at `shapes` (3 × vertices, m).
std::vector<std::vector<ContactPlane>> contact_planes(Neighbors& neighbors, const std::vector<Points>& shapes,
                                                      const Look& look = {});

/// What takes vertices that lie deep in another muscle out of it, with what lies around them (penetration_repair.hpp):
/// per muscle 3 × vertices, m, or nothing where it stays. Only of muscles that the last contact_planes saw deeper in
/// each other than at rest, since when nothing has come nearer by more than `moved` (m).
std::vector<Points> ways_apart(Neighbors& neighbors, const std::vector<Points>& shapes, Real moved);

}  // namespace gracilis::tissue
