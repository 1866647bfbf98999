#pragma once

#include <gracilis/opensim/import/muscle_volume.hpp>

namespace gracilis::opensim {

/// A closed surface over the lines of several heads of a muscle (anatomy/sections/sheet.hpp). Sections lie at equal
/// shares of the heads' bellies and tendons, and are nearly the hulls of the heads' own; these swell so far that the
/// belly has the volume of the heads' bellies together. Outside of the bones, as muscle_volume has it. Heads are
/// ordered from edge to edge; ends are held by the bodies of the nearest heads. Throws InputError as muscle_volume
/// does, and where the sheet would cut itself. Precondition: two heads or more, of which no surface is known.
MuscleVolume sheet_volume(const Model& model, const std::vector<const Muscle*>& heads,
                          const std::vector<RigidTransform>& poses, const Eigen::VectorXd& coordinates,
                          const VolumeSettings& settings);

}  // namespace gracilis::opensim
