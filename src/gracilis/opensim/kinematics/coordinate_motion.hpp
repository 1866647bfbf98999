#pragma once

#include <gracilis/io/tables/table.hpp>
#include <gracilis/opensim/reader/model.hpp>

#include <string>
#include <vector>

namespace gracilis::opensim {

/// Values of all of a model's coordinates over time: a row per time, in rad and m.
struct CoordinateMotion {
  std::vector<Real> times;
  Eigen::MatrixXd values;
  std::vector<std::string> notes;  ///< what was amiss but could be survived, a sentence each
};

/// The coordinates of a table, by name or by OpenSim's state paths (/jointset/hip_r/hip_flexion_r/value); angles are
/// turned into radians where the table is in degrees. Coordinates that it lacks keep their default values; couplers
/// then set dependent ones, and loops are closed (complete_rows). Throws InputError where no column is a coordinate.
CoordinateMotion coordinate_motion(const Model& model, const Table& table);

/// Sets in all rows what couplers and closed loops set (LoopCloser), from row to row and from the default pose to the
/// first. `held` are the coordinates whose values are given; what had to give way or stays open is noted.
void complete_rows(const Model& model, const std::vector<bool>& held, CoordinateMotion& motion);

/// One coordinate from `begin` to `end` by `step` (rad or m, step not zero, at most 100,000 rows), 0.01 s each, the
/// others at their default values.
CoordinateMotion sweep(const Model& model, Index coordinate, Real begin, Real end, Real step);

/// The motion as a table in degrees and m.
Table coordinate_table(const Model& model, const CoordinateMotion& motion);

}  // namespace gracilis::opensim
