#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <array>
#include <vector>

namespace gracilis::opensim {

/// A coordinate that points may move with, and its value in every frame, rad or m.
struct FollowedCoordinate {
  Index coordinate = -1;
  std::vector<Real> values;
};

/// One component of a point's place as a spline of its coordinate, through `values` (m) at `knots` (rad or m); without
/// knots it stays.
struct FollowedComponent {
  std::vector<Real> knots, values;
  Real left = 0;  ///< m, root mean square about the spline, without one about the mean
};

/// A point of a muscle's mean fiber, with the body that it moves with most nearly.
struct FiberPoint {
  Index body = 0;
  Vec3 location = Vec3::Zero();  ///< in the body's frame, m; its mean over the frames
  Real moves = 0;                ///< m, root mean square about that mean
  Real left = 0;                 ///< m, the same about where it is with its coordinate; without one `moves`
  Index coordinate = -1;         ///< that all of its components follow, as OpenSim has it; -1: it stays
  std::array<FollowedComponent, 3> follows;
};

/// Where points (3 × n each, ground frame, one matrix per frame) stay best: for each the body in which it moves least.
/// `poses` are the bodies' in each frame. An inner point follows one of `moving` with all its components: that which
/// predicts left-out frames best, by polynomials of up to the sixth order. A component of which a polynomial would
/// leave 0.7 of the movement stays. So do the ends, unless they move by more than 0.5 mm.
std::vector<FiberPoint> fit_points(const std::vector<Points>& fibers,
                                   const std::vector<std::vector<RigidTransform>>& poses,
                                   const std::vector<FollowedCoordinate>& moving);

/// A muscle's path made of such points, as a model has it.
Path path_of(const std::vector<FiberPoint>& points);

}  // namespace gracilis::opensim
