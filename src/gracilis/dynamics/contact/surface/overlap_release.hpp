#pragma once

#include <gracilis/dynamics/contact/surface/exit_side.hpp>

namespace gracilis {

/// Bounds what a contact may ask for within a step by where the step began. What came in since then has to go out
/// again; what was in before comes out gradually.
struct OverlapRelease {
  ExitSide exit;                      ///< of the surface that the particle is near to
  const Particles &probe, &target;    ///< before the step
  const Eigen::Matrix3Xf& normals;    ///< of the target
  Eigen::Vector3f shift;              ///< from the probe's coordinates to the target's
  const std::vector<char>& overlaps;  ///< which of the probe's particles lie in the target at rest; empty: none
  float speed = 0;                    ///< m per step, SurfacePair::release

  /// The most that the candidate may be asked to keep, m, where `gap` is what it shall keep in the end; infinite where
  /// that is near enough.
  float most_gap(const VertexFaceCandidate& candidate, float gap) const;
};

/// How far a distance may grow towards `gap` within a step that began with `before`, m: by `speed` at most.
float released(float before, float gap, float speed);

/// What is missing from a gap by less than this is asked for at once where nothing overlaps at rest, m.
inline constexpr float asked_at_once = 0.0005f;
/// The steps in which two surfaces come apart that overlap at rest, and how far at least in each of them, m.
inline constexpr float release_steps = 35, least_release = 0.00005f;

}  // namespace gracilis
