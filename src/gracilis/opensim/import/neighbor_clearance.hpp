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

/// The muscle's centers beside the others' lines, those that are too near to the same line one after the other on the
/// same side of it, 30 mm aside at most. Thin sections, as those of a tendon, go out of thicker parts of the others, to
/// where the two touch; of two that are about as thick each does its part, until half of their radii lies between their
/// lines, which leaves both room. Sections beside them go along, so that the line bends softly; the first and the last
/// stay, since muscles may well have one place there.
Points beside_bellies(const RoundMuscle& muscle, const std::vector<RoundMuscle>& others);

/// All of these, by their names, when each has given way to the others several times, outside of the bones, through
/// which none goes.
std::map<std::string, RoundMuscle> beside_bellies(const std::map<std::string, RoundMuscle>& muscles,
                                                  const std::vector<SolidBone>& bones);

/// The room that all of these, by their names, leave to what is called `own`; empty where there are no others.
RoomBeside room_left(const std::map<std::string, RoundMuscle>& all, const std::vector<std::string>& own);

}  // namespace gracilis::opensim
