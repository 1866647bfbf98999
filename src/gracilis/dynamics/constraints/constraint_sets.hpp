#pragma once

#include <gracilis/core/aligned.hpp>
#include <gracilis/core/types.hpp>
#include <gracilis/dynamics/simd/group_width.hpp>

#include <array>
#include <vector>

namespace gracilis {

/// Slots of one color: [begin, end), multiples of group_width: every color is padded to whole groups with constraints
/// between copies of the idle particle, which has no mass to move.
struct ColorRange {
  Index begin = 0, end = 0;
};

/// In which order constraints are taken: the colors one after the other, which any number of threads may shorten.
/// Colors [clusters[i], clusters[i + 1]) belong to cluster i, whose particles no other cluster touches, so that
/// clusters run side by side, each within a cache; what lies across clusters comes after the last of them, color by
/// color.
struct ColorOrder {
  std::vector<ColorRange> colors;
  std::vector<Index> clusters = {0};

  Index cluster_count() const { return static_cast<Index>(clusters.size()) - 1; }
};

/// Two particles keep a distance: C = |x_b - x_a| - length (Müller et al. 2007).
struct DistanceSet {
  AlignedVector<Index> a, b;
  AlignedVector<float> rest_length;  ///< m, in the capture pose
  AlignedVector<float> compliance;   ///< m/N
  ColorOrder order;
  std::vector<Index> slot;  ///< where constraint i of the input went
  Index count = 0;          ///< without padding
};

/// Two triangles keep the angle at their shared edge: C = θ(x) - θ_rest, θ the signed angle between the normals.
/// Particles: the edge runs from `particles[0]` to `particles[1]`; [2] is the apex on its left, [3] on its right.
struct HingeSet {
  std::array<AlignedVector<Index>, 4> particles;
  AlignedVector<float> rest_angle;   ///< rad
  AlignedVector<float> compliance;   ///< 1/(N·m)
  AlignedVector<float> edge_length;  ///< m, in the capture pose
  ColorOrder order;
  Index count = 0;
};

/// A closed surface keeps its volume: C = V(x) - V_target (Müller et al. 2007, with the factor 1/6 of a volume). The
/// ring of a vertex lists its neighbors counter-clockwise seen from outside and ends with the first again; gradients
/// are sums over rings, so no two vertices ever write to the same place. Vertices with rings of nearly equal length
/// stand in groups; shorter rings repeat their last neighbor, which adds nothing.
struct VolumeSet {
  AlignedVector<Index> particles;   ///< group_width per group, padded with the idle particle
  std::vector<Index> ring_offsets;  ///< of each group, and the end: steps in `ring`
  AlignedVector<Index> ring;        ///< group_width neighbors per step
  double target = 0;                ///< m³
  double compliance = 0;            ///< m³·m³/J

  Index group_count() const { return static_cast<Index>(particles.size()) / group_width; }
};

/// Input of the two builders: one constraint each.
struct DistanceConstraint {
  Index a = 0, b = 0;
  Real rest_length = 0, compliance = 0;
};
struct HingeConstraint {
  std::array<Index, 4> particles{};
  Real rest_angle = 0, compliance = 0, edge_length = 0;
};

/// Clusters, colors, groups and pads constraints over `particle_count` particles; particle number `particle_count` is
/// the idle one. Neighbors should have near numbers (breadth-first): clusters are ranges of numbers.
DistanceSet build_distance_set(const std::vector<DistanceConstraint>& constraints, Index particle_count);
HingeSet build_hinge_set(const std::vector<HingeConstraint>& constraints, Index particle_count);

/// Rings of a closed, oriented manifold surface. Precondition: every edge has one face on each side and every vertex
/// one fan.
VolumeSet build_volume_set(const Eigen::Matrix3Xi& faces, Index particle_count, Real target, Real compliance);

}  // namespace gracilis
