#pragma once

#include <gracilis/opensim/paths/muscle_path.hpp>

namespace gracilis::opensim {

/// A path's length (m) as OpenSim (4.4 and later) computes it, for numbers that are held against its own; the
/// skeleton's as placed at `coordinates`. It is not quite that of a way: around a path's only wrap, a cylinder, OpenSim
/// takes `cylinder_by_opensim`, and where a line runs around two surfaces it adds the straight parts as its first round
/// leaves them to the arcs of its last.
Real length_by_opensim(const Skeleton& skeleton, const Path& path, const Eigen::VectorXd& coordinates);

/// The way around a cylinder that OpenSim takes where a path has no other wrap: it touches where the shortest does but
/// at the heights at which a plane through both points cuts the lines of tangency. The plane holds the point of the
/// axis that is as high as the line is where it divides like the points' distances from the axis. The way is longer
/// than the shortest by micrometres. One that turns by more than half a circle, where the plane means nothing, is the
/// shortest.
Wrap cylinder_by_opensim(const WrapSurface& cylinder, const Vec3& a, const Vec3& b);

}  // namespace gracilis::opensim
