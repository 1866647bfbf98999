#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/scene/scene.hpp>

namespace gracilis {

/// Fills a muscle with fibers that follow lines on or near its surface (after Kohout and Cholt 2017):
/// `muscle.fibers.count` lines of `muscle.fibers.segments` pieces from origin to insertion.
///
/// Each line is smoothed by a centripetal Catmull-Rom spline. Where it passes a cross-section of the muscle it tells
/// which place across the muscle, the first coordinate a of the section's unit square, belongs to it; a line that does
/// not reach a section keeps its place of the nearest section that it reaches. Between the lines the places follow by a
/// centripetal Catmull-Rom spline across the muscle, whose ends are the muscle's sides; so fibers between two lines run
/// between them in every section and at every depth. Lines of several heads are told apart by their places alone.
/// Without a usable line these are the fibers of the parallel template.
Polylines filled_between(const Muscle& muscle, const Polylines& lines);

}  // namespace gracilis
