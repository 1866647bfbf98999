#pragma once

#include <gracilis/opensim/export/model_samples.hpp>
#include <gracilis/opensim/export/run_lengths.hpp>
#include <gracilis/transfer/body_frames.hpp>

#include <set>
#include <string>
#include <vector>

namespace gracilis {

/// How far lengths and arms of a muscle along its points are from the scene's.
struct WrappedMuscle {
  std::string name;
  Index points = 0, poses = 0;  ///< of the path; that were compared
  bool held_out = false;        ///< those that points were not fitted to; where there are none, those they were
  opensim::PathErrors errors;
};

/// "flexor: 5 points; 8 held-out poses: lengths ...".
std::string to_string(const WrappedMuscle& muscle);

/// A model's muscles along the mean fibers of a scene's, and what became of each.
struct WrappedMuscles {
  std::vector<opensim::Muscle> muscles;  ///< of the model, with new paths and tendons' slack lengths
  std::vector<WrappedMuscle> told;       ///< of those
  std::vector<std::string> left_out;     ///< those of the scene that are not written: which, and why
};

/// The share of the poses that points are not fitted to: the last ones.
inline constexpr Real held_out_share = 0.2;

/// The scene's bodies that path points of muscles of the same names may lie on: those of the ends of each, in the scene
/// and in the model, and those between. Empty where no muscle of the scene has a name of the model's.
std::set<Index> bodies_to_share(const opensim::Model& model, const Scene& scene);

/// Fits path points on the shared bodies to the mean fibers in all but the held-out poses (points_of). Lengths and arms
/// are those along the points as the model moves them. `samples`: of the scene in spread poses with mean fibers
/// (scene_lengths). Points lie on bodies alone that are between the muscle's ends, in the model or the scene.
WrappedMuscles wrap_muscles(const opensim::Model& model, const Scene& scene, const std::vector<SharedBody>& shared,
                            const opensim::LengthSamples& samples);

/// The ranges of those coordinates of the model that the scene has an axis of and that a muscle of it crosses, as far
/// as both allow. Dependent ones are left out.
opensim::CoordinateBox shared_ranges(const opensim::Model& model, const Scene& scene);

}  // namespace gracilis
