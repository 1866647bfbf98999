#pragma once

#include <gracilis/core/aligned.hpp>
#include <gracilis/dynamics/particles.hpp>
#include <gracilis/dynamics/simd/group_width.hpp>

#include <vector>

namespace gracilis {

/// A closed surface keeps its volume: \f$C = V(x) - V_0\f$ (Müller et al. 2007, with the factor 1/6 of a volume). The
/// ring of a vertex lists its neighbors counter-clockwise seen from outside and ends with the first again; gradients
/// are sums over rings, so no two vertices ever write to the same place. Vertices with rings of nearly equal length
/// stand in groups; shorter rings repeat their last neighbor, which adds nothing.
struct VolumeSet {
  AlignedVector<Index> particles;   ///< group_width per group, padded with an idle particle
  std::vector<Index> ring_offsets;  ///< of each group, and the end: steps in `ring`
  AlignedVector<Index> ring;        ///< group_width neighbors per step
  double target = 0;                ///< m³
  double compliance = 0;            ///< m³·m³/J

  /// Of group_width particles.
  Index group_count() const { return static_cast<Index>(particles.size()) / group_width; }
};

/// Rings of a closed, oriented manifold surface. Precondition: every edge has one face on each side and every vertex
/// one fan.
VolumeSet build_volume_set(const Eigen::Matrix3Xi& faces, Index particle_count, Real target, Real compliance);

/// Projects the volume constraint; `gradients` (four floats per particle, like positions) is workspace, `lambda` is
/// accumulated. Returns the volume before the projection, m³. Deterministic for any number of threads.
double project_volume(const VolumeSet& set, double time_step, double pressure, double& lambda,
                      AlignedVector<float>& gradients, Particles& particles);

/// The volume now, m³; `gradients` as above.
double enclosed_volume(const VolumeSet& set, AlignedVector<float>& gradients, const Particles& particles);

}  // namespace gracilis
