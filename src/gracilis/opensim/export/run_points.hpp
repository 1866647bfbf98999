#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis::opensim {

/// A point of a muscle's mean fiber, with the body that it moves with most nearly.
struct FiberPoint {
  Index body = 0;
  Vec3 location = Vec3::Zero();  ///< in the body's frame, m; its mean over the frames
  Real moves = 0;                ///< m, root mean square about that mean
  Real left = 0;                 ///< m, the same about where it is with its coordinate; without one `moves`
  /// Where the point moves with a coordinate: its place in the body for each of these values, rad or m; else empty.
  std::vector<Real> knots;
  Points places = Points(3, 0);
};

/// Where points (3 × n each, ground frame, one matrix per frame) stay best: for each the body in which it moves least.
/// `poses` are the bodies' in each frame. Inner points move in their bodies with one coordinate (`moving`, its value
/// per frame; empty: they stay), at up to 15 of its values, where that leaves less than 0.7 of their movement; what
/// other coordinates do to them is averaged. The ends stay, unless they move by more than 0.5 mm, as moving path points
/// do.
std::vector<FiberPoint> fit_points(const std::vector<Points>& fibers,
                                   const std::vector<std::vector<RigidTransform>>& poses,
                                   const std::vector<Real>& moving);

/// A muscle's path made of such points, as a model has it; `coordinate` is the one that moves them, or -1.
Path path_of(const std::vector<FiberPoint>& points, Index coordinate);

/// The muscle as an element of a ForceSet of version 4.0, with its points and parameters.
std::string muscle_text(const Model& model, const Muscle& muscle);

/// Writes the mean fibers of a run's muscles as paths of `count` points: a ForceSet that OpenSim appends to the model
/// or puts in the place of its forces. Muscles that the model has keep their parameters; their points move with that
/// coordinate, of those that the muscle crosses and the one that changes most, that leaves least. The set is
/// read again, and a line returned for each muscle: how far its lengths then are from the run's. The run's scene must have
/// been made of the model, or share its bodies' places and coordinates. Throws InputError.
std::vector<std::string> export_points(const std::filesystem::path& run, const Model& model, Index count,
                                       const std::filesystem::path& out);

}  // namespace gracilis::opensim
