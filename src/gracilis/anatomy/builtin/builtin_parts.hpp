#pragma once

#include <gracilis/anatomy/builtin/builtin_muscles.hpp>
#include <gracilis/core/types.hpp>
#include <gracilis/scene/scene.hpp>

#include <string>
#include <vector>

namespace gracilis::builtin_shapes {

/// The bones' surfaces, and the same as obstacles for muscles.
struct Skeleton {
  std::vector<Bone> bones;
  std::vector<ImplicitSolid> solids;
};

/// Meshes the solid with edges of 3.3 mm and adds it to the skeleton as a bone of `body`.
void add_bone(Skeleton& skeleton, const std::string& name, Index body, const ImplicitSolid& solid);

/// How far muscles stay from bones and from each other at rest; m.
struct Gaps {
  Real bone = 0.0018;
  Real muscle = 0.0015;
};

/// Makes the muscles in the order of the plans, each clear of all bones and of the muscles before it, and attaches each
/// to the bones that its plan names: with the vertices that are within 4.2 mm of them and in the part of the sheet that
/// is this end.
std::vector<Muscle> make_muscles(const std::vector<MusclePlan>& plans, const Skeleton& skeleton, const Gaps& gaps);

/// The muscles of these plans without their surfaces, their attachments without vertices.
std::vector<Muscle> outlined_muscles(const std::vector<MusclePlan>& plans);

/// A motion of one coordinate from 0 to `last` (rad, at least 0) in steps of `step` (rad, above 0), `time_step` (s)
/// apart.
Motion ramp_from_zero(const std::string& name, const std::string& coordinate, Real last, Real step, Real time_step);

}  // namespace gracilis::builtin_shapes
