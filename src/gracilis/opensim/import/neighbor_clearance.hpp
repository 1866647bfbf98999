#pragma once

#include <gracilis/opensim/import/bone_clearance.hpp>

#include <map>
#include <string>
#include <vector>

namespace gracilis::opensim {

/// A muscle as round sections about its line.
struct RoundMuscle {
  Points centers;
  Eigen::VectorXd radii;  ///< m, more than 0
};

/// The room that these muscles leave to another: a ray is free as long as its points are nearer to its own center than
/// to any of their lines, each measured in radii there. Muscles that lie in each other share what both cover, a thick
/// one more of it than a thin one, and half a millimetre is left between them.
RoomBeside room_beside(std::vector<RoundMuscle> muscles);

/// The muscle's centers with thin sections, as those of a tendon, brought out of thicker parts of the others: to where
/// the two touch, those that lie in the same muscle one after the other to the same side, by 30 mm at most. Sections
/// beside them go along, so that the line bends softly; the first and the last stay, since muscles may well have one
/// place there.
Points beside_bellies(const RoundMuscle& muscle, const std::vector<RoundMuscle>& others);

/// The same of all of these, by their names, outside of the bones.
std::map<std::string, RoundMuscle> beside_bellies(const std::map<std::string, RoundMuscle>& muscles,
                                                  const std::vector<SolidBone>& bones);

/// The room that all of these, by their names, leave to what is called `own`; empty where there are no others.
RoomBeside room_left(const std::map<std::string, RoundMuscle>& all, const std::vector<std::string>& own);

}  // namespace gracilis::opensim
