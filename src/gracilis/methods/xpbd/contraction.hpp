#pragma once

#include <gracilis/methods/xpbd/preparation.hpp>

namespace gracilis::xpbd {

/// Gives a muscle what it needs to contract. The tension across each metre of the surface's width is the same however
/// many fibers there are: either every edge that runs more along the fibers than across them pulls by its direction
/// (`spread`), or the segments of the surface fibers do, each for the strip of the surface that is nearest to it.
/// Without `area_scaling` each segment acts with the stiffness itself, as often as fibers run over it (Havlíček 2024).
/// Tendons pull less, attachments not at all. Preconditions: `muscle` is the scene's; particles, attachments and faces
/// of `prepared` are there, `topology` is in particle numbers.
void build_contractions(const Muscle& muscle, const MeshTopology& topology, PreparedMuscle& prepared);

/// How strongly a muscle pulls, a factor on its contractions' stiffness: 0 up to the threshold, then growing with the
/// activation to 1 where fibers aim at the shortest. Without `ramp` it is 1 at once, and with a threshold of 0 always.
Real contraction_strength(const ContractionSettings& settings, Real activation);

/// Sets what the contractions aim at: along the fibers the contracted share of the length at rest, across them all of
/// it, or what it is on the skinned surface (none: nullptr) where that is wider.
void set_contraction_lengths(const PreparedMuscle& muscle, Real activation, const strings::SkinnedSurface* skinned,
                             AlignedVector<float>& tension_length);

}  // namespace gracilis::xpbd
