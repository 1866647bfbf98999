#pragma once

#include <gracilis/core/aligned.hpp>
#include <gracilis/dynamics/constraints/color_order.hpp>
#include <gracilis/dynamics/constraints/projection_parameters.hpp>
#include <gracilis/dynamics/particles.hpp>

#include <vector>

namespace gracilis {

struct StrainLimitActiveSet;

/// Two particles keep a distance: \f$C = |x_b - x_a| - L\f$, L its length (Müller et al. 2007).
struct DistanceSet {
  AlignedVector<Index> a, b;
  AlignedVector<float> rest_length;  ///< m, in the capture pose
  AlignedVector<float> compliance;   ///< m/N
  ColorOrder order;
  std::vector<Index> slot;  ///< where constraint i of the input went
  Index count = 0;          ///< without padding
};

/// One constraint, input of the builder.
struct DistanceConstraint {
  Index a = 0, b = 0;
  Real rest_length = 0, compliance = 0;
};

/// Lays out constraints over `particle_count` particles, which the idle ones follow (color_order.hpp).
DistanceSet build_distance_set(const std::vector<DistanceConstraint>& constraints, Index particle_count);

/// Projects distance constraints of slots [begin, end), which belong to one color. `target_length` (m) and `lambda` (N
/// s²) have one entry per slot; `start` are the particles at the substep's beginning; groups in which edges come near
/// the strain limit become active in `limited`. Vectorised for the machine it runs on.
ProjectionCounts project_distances(const DistanceSet& set, ColorRange range, const float* target_length, float* lambda,
                                   const Particles& start, Particles& particles, const ProjectionParameters& parameters,
                                   StrainLimitActiveSet* limited = nullptr);

}  // namespace gracilis
