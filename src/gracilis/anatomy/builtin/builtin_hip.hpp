#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/scene/scene.hpp>

namespace gracilis {

struct BuiltinHipOptions {
  Real last_flexion = radians(90);  ///< rad; the motion flexes from 0 to here
  Real flexion_step = radians(1);   ///< rad per frame
  Real time_step = 1.0 / 60;        ///< s between frames
  Real bone_gap = 0.0018;           ///< m, between every muscle and every bone at rest
  Real muscle_gap = 0.0015;         ///< m, between any two muscles at rest
};

/// A complete scene without any file: a standing person's pelvis and right femur, modeled as implicit surfaces about
/// published landmarks, and six muscles that cross only the hip, with volumes after Handsfield et al. 2014; the motion
/// is hip flexion.
///
/// Frame: metres, origin at the center of the right hip joint, x anterior, y superior, z to the subject's right.
/// Bodies: pelvis (fixed), femur_r. Joint hip_r turns about z (hip_flexion_r, positive moves the knee forward), then x
/// (hip_adduction_r, positive towards the midline), then y (hip_rotation_r, positive internal), as OpenSim's gait
/// models do. Takes one to a few seconds (demo_scene of io/scene/demo_scene.hpp has the default one at once); the same
/// bits for any number of threads. Preconditions: last_flexion >= 0, flexion_step > 0, time_step > 0.
Scene builtin_hip(const BuiltinHipOptions& options = {});

/// The same without surfaces, in no time: put_surfaces (builtin_surfaces.hpp) puts in those that are known.
Scene builtin_hip_outline(const BuiltinHipOptions& options = {});

}  // namespace gracilis
