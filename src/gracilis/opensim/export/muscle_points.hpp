#pragma once

#include <gracilis/opensim/export/fiber_points.hpp>
#include <gracilis/opensim/export/path_samples.hpp>
#include <gracilis/opensim/export/run_lengths.hpp>
#include <gracilis/opensim/kinematics/skeleton.hpp>

#include <string>
#include <vector>

namespace gracilis::opensim {

/// What points of one muscle are fitted to: poses in which its fibers are known.
struct KnownFibers {
  LengthSamples samples;                           ///< of this muscle alone
  std::vector<Points> lines;                       ///< its mean fiber in each pose, m
  std::vector<std::vector<RigidTransform>> poses;  ///< of bodies, in the same frame as lines
  std::vector<Index> bodies = {};                  ///< the model's that `poses` are of, on which points may be
};

/// Points along a muscle's mean fiber, as export_points writes them; `why` says what stands against it where there are
/// none. `own`: the model's muscle, if it has it.
std::vector<FiberPoint> points_of(Skeleton& skeleton, const KnownFibers& known, const Muscle* own, std::string& why);

/// How far a path's lengths are from those of the fibers, and its arms from the samples' or else from those of `own`;
/// of angles.
PathErrors point_errors(Skeleton& skeleton, const Path& path, const Path* own, const KnownFibers& known);

/// One line for people; `beside_model`: the errors are those from the model's own muscle.
std::string point_errors_text(const PathErrors& errors, bool beside_model);

/// The model's muscle, or a new one, along these points. Fibers are no longer than they were in the capture pose: what
/// the way is longer there is tendon.
Muscle muscle_along(Skeleton& skeleton, const std::vector<FiberPoint>& points, const std::string& name,
                    const Muscle* own, const Eigen::VectorXd& capture);

}  // namespace gracilis::opensim
