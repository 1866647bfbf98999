#pragma once

#include <gracilis/dynamics/contact/self/self_contact.hpp>
#include <gracilis/dynamics/contact/surface/contact_world.hpp>
#include <gracilis/dynamics/contact/surface/exit_side.hpp>

namespace gracilis {

/// Notes which point of the target is nearest to a candidate's particle, which is at p in the target's coordinates.
inline void note_nearest(const Eigen::Vector3f& p, const NearestFace& nearest, const ContactSurface& surface,
                         const Particles& target, VertexFaceCandidate& candidate) {
  candidate.face = nearest.face;
  candidate.barycentric = nearest.barycentric;
  candidate.offset = p - point_on(surface, nearest, target);
}

/// One surface's part in a search; the tree is fitted to the particles.
struct SearchedSurface {
  const ContactSurface& surface;
  const Particles& particles;
  const PatchTree& tree;
};

/// The nearest face of the target within `reach` (m) of each particle of the probe, in the order of particles; `shift`
/// leads from the probe's coordinates to the target's.
void find_near(const SearchedSurface& probe, const Eigen::Vector3f& shift, const SearchedSurface& target, float reach,
               std::vector<VertexFaceCandidate>& found);
/// The same; for a particle inside that has a side to come out on only its exits count.
void find_near(const SearchedSurface& probe, const Eigen::Vector3f& shift, const SearchedSurface& target, float reach,
               const ExitSide& exit, std::vector<VertexFaceCandidate>& found);

/// The nearest face of the same surface within `reach` (m) that each particle may meet, in the order of particles.
void find_self(const SearchedSurface& surface, const SelfRule& rule, float reach,
               std::vector<VertexFaceCandidate>& found);

}  // namespace gracilis
