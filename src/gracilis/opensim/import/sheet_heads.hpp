#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/opensim/import/muscle_line.hpp>

#include <vector>

namespace gracilis::opensim {

/// One head of a sheet, and its sections as they would be alone.
struct SheetHead {
  MuscleLine own;
  Points centers;
  Eigen::VectorXd radii;  ///< m

  Real length() const { return polyline_length(own.line.points); }  ///< m
};

/// How many parts lie between a sheet's sections: in the origin's tendon, the belly and the insertion's tendon.
struct SheetParts {
  Index origin_tendon = 0, belly = 0, tendon = 0;
};

struct SheetHeads {
  std::vector<SheetHead> heads;  ///< from edge to edge
  SheetParts parts;
};

/// The heads in order of where their lines lie, along the direction in which these spread most, the edge nearer to the
/// model's first one first; with as many sections each, at equal shares of bellies and tendons, which are no farther
/// apart in the mean of the heads than settings have it. Throws InputError as muscle_line does. Precondition: two or
/// more.
SheetHeads sheet_heads(const Model& model, const std::vector<const Muscle*>& muscles,
                       const std::vector<RigidTransform>& poses, const Eigen::VectorXd& coordinates,
                       const VolumeSettings& settings);

}  // namespace gracilis::opensim
