#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/scene/scene.hpp>

namespace gracilis {

struct BuiltinElbowOptions {
  Real last_flexion = radians(130);  ///< rad; the motion flexes from 0 to here
  Real flexion_step = radians(2);    ///< rad per frame
};

/// A complete scene without any file: a right arm that hangs straight with the palm forward, modeled as implicit
/// surfaces about published sizes, and the seven muscle heads that bend and straighten the elbow, with volumes after
/// Holzbaur et al. 2007; the motion is flexion of the elbow.
///
/// Frame: metres, origin on the elbow's axis, x anterior, y superior, z to the subject's right. Bodies: scapula_r
/// (fixed), humerus_r, ulna_r, radius_r. Joints: shoulder_r turns about the center of the humeral head by
/// shoulder_flexion (about z, positive forward); elbow_r about z by elbow_flexion (0 straight, positive flexes), whose
/// axis runs through trochlea and capitulum; radioulnar_r about the line from the radial head to the ulna's by pro_sup
/// (-90 degrees in the capture pose, positive pronates). Takes a few seconds (demo_scene has the default one at once);
/// the same bits for any number of threads. Preconditions: last_flexion >= 0, flexion_step > 0.
Scene builtin_elbow(const BuiltinElbowOptions& options = {});

/// The same without surfaces, in no time: put_surfaces (builtin_surfaces.hpp) puts in those that are known.
Scene builtin_elbow_outline(const BuiltinElbowOptions& options = {});

}  // namespace gracilis
