#pragma once

#include <gracilis/opensim/kinematics/coordinate_motion.hpp>

#include <string>
#include <utility>
#include <vector>

namespace gracilis::opensim {

/// Lengths and moment arms of all of a model's muscles through a motion, a column per muscle.
struct PathTables {
  Table lengths;                                           ///< m, as OpenSim computes them (length_by_opensim)
  Table way_lengths;                                       ///< m, of the ways, which the moment arms are of
  std::vector<std::pair<std::string, Table>> moment_arms;  ///< by coordinate: those that any muscle acts on, m
};

/// The model must have muscles, the motion rows.
PathTables path_tables(const Model& model, const CoordinateMotion& motion);

/// A muscle whose length by OpenSim is not that of its way.
struct LengthsApart {
  std::string muscle;
  Real most = 0;  ///< m, the largest difference in any row
};

/// The muscles whose two lengths differ by more than 0.1 mm in some row, in the tables' order.
std::vector<LengthsApart> lengths_apart(const PathTables& tables);

}  // namespace gracilis::opensim
