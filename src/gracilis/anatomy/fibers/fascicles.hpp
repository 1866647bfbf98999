#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/scene/scene.hpp>

namespace gracilis {

/// Fibers that end on aponeuroses: `muscle.fibers.count` lines of `muscle.fibers.segments` pieces, from origin to
/// insertion, that fill the belly evenly and lie inside. A smooth direction field is followed both ways to the muscle's
/// surface or to an aponeurosis in it. It is fitted to the muscle's measured tracts; where it has none, to lines
/// between its aponeuroses, if it has such or its attachments are spread like them; else, where `ends` asks for
/// aponeuroses, it lies at the pennation angle between the broad sides. Empty where none of this holds, and where
/// `ends` asks for attachments and there are no tracts. Deterministic for any number of threads. Precondition: there is
/// an origin and an insertion.
Polylines fascicles_of(const Muscle& muscle);

}  // namespace gracilis
