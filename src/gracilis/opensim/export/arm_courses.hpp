#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <string>
#include <vector>

namespace gracilis::opensim {

/// A muscle's moment arm about one coordinate while that goes through a run's range and the others stay at their means.
struct ArmCourse {
  std::string coordinate, muscle;
  bool rotation = true;
  std::vector<Real> at;                    ///< rad or m
  std::vector<Real> before, after;         ///< m per rad (of translations 1): the model's own path, and the other
  Real root_mean_square = 0, largest = 0;  ///< of their difference
};

/// For each coordinate that the run (`coordinates`: rows of all of the model's) moves by a degree or a millimetre, and
/// each muscle with an arm of a millimetre about it by either model. The models differ in their muscles' paths alone.
/// Ordered by coordinate, and within one by the difference, largest first.
std::vector<ArmCourse> arm_courses(const Model& before, const Model& after, const Eigen::MatrixXd& coordinates,
                                   int steps = 40);

}  // namespace gracilis::opensim
