#pragma once

#include <gracilis/dynamics/constraints/constraint_sets.hpp>
#include <gracilis/dynamics/constraints/stretch_watch.hpp>
#include <gracilis/dynamics/particles.hpp>

namespace gracilis {

/// What the projections of one substep share. XPBD (Macklin, Müller, Chentanez 2016) moves each constraint's multiplier
/// by
///   Δλ = (-C - α̃ λ - γ ∇C·(x - xⁿ)) / ((1 + γ) ∇C w ∇Cᵀ + α̃),  α̃ = α/dt²,  γ = α̃ β̃/dt,  β̃ = dt² β
/// and the particles by w ∇Cᵀ Δλ, w the inverse masses and xⁿ the substep's start.
struct ProjectionParameters {
  float time_step = 1.0f / 60;  ///< s
  float rayleigh_beta = 0;      ///< dissipation; 0: the start positions are not read
  float hinge_limit = 0;        ///< largest motion by one hinge projection as a share of its edge; 0: none
  bool arccos_hinges = false;   ///< the published angle measure
};

/// What one pass did besides moving particles.
struct ProjectionCounts {
  Index limited = 0;  ///< hinges held back by the limit
  Index skipped = 0;  ///< constraints without a usable gradient
};

/// Projects distance constraints of slots [begin, end), which belong to one color. `target_length` (m) and `lambda` (N
/// s²) have one entry per slot; `start` are the particles at the substep's beginning; where edges come near the limit
/// is noted in `watch`. Vectorised for the machine it runs on.
ProjectionCounts project_distances(const DistanceSet& set, ColorRange range, const float* target_length, float* lambda,
                                   const Particles& start, Particles& particles, const ProjectionParameters& parameters,
                                   StretchWatch* watch = nullptr);

/// Projects contractions of slots [begin, end), which belong to one color: distance constraints that only pull, C =
/// target_length - |x_b - x_a| >= 0. A segment that is shorter than its target is left alone, except that it gives back
/// what it was pulled too far within this substep. `strength` > 0 is a factor on the stiffness.
ProjectionCounts project_contractions(const DistanceSet& set, ColorRange range, const float* target_length,
                                      float strength, float* lambda, Particles& particles,
                                      const ProjectionParameters& parameters);

/// Shortens edges that are longer than `limit` times their rest length to that length, without compliance and without a
/// multiplier: C = limit · length_rest - |x_b - x_a| >= 0. With a `watch`, looks only where
/// that says. Returns how many were limited.
Index limit_stretch(const DistanceSet& set, ColorRange range, float limit, Particles& particles,
                    const StretchWatch* watch = nullptr);

/// Projects hinges of slots [begin, end), which belong to one color; `lambda` in N·m s².
ProjectionCounts project_hinges(const HingeSet& set, ColorRange range, float* lambda, const Particles& start,
                                Particles& particles, const ProjectionParameters& parameters);

/// Projects the volume constraint; `gradients` (four floats per particle, like positions) is workspace, `lambda` is
/// accumulated. Returns the volume before the projection, m³. Deterministic for any number of threads.
double project_volume(const VolumeSet& set, double time_step, double pressure, double& lambda,
                      AlignedVector<float>& gradients, Particles& particles);

/// The volume now, m³; `gradients` as above.
double enclosed_volume(const VolumeSet& set, AlignedVector<float>& gradients, const Particles& particles);

/// The instruction set in use, e.g. "AVX3": part of a run's manifest, because results differ in the last bits between
/// sets.
const char* instruction_set();

}  // namespace gracilis
