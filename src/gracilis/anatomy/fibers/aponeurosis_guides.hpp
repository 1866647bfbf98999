#pragma once

#include <gracilis/anatomy/fibers/fiber_field.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/scene/scene.hpp>

#include <optional>
#include <vector>

namespace gracilis {

/// A muscle's aponeuroses of one end, or all, as one surface.
TriangleMesh aponeuroses_of(const Muscle& muscle, std::optional<AttachmentEnd> end = {});

/// Straight lines from where fibers begin to where they end: the aponeuroses of each end, or its attachments where it
/// has none. As many points are spread over both, evenly by area, and joined so that the sum of squared lengths is
/// least: who lies proximal on one lies proximal on the other, and no two lines cross. How the two lie to each other
/// thus says the pennation. `count` lines. Precondition: there is an origin and an insertion.
Polylines lines_between_ends(const Muscle& muscle, Index count);

/// Whether attachments are spread along the belly as aponeuroses are: along the fibers between them, the origin reaches
/// past where the insertion begins by at least half of a fiber's length. Attachments of muscles whose fibers run from
/// end to end lie one behind the other, however broad they are.
bool attachments_are_spread(const Muscle& muscle);

/// Directions at the pennation angle to the muscle's line of action, from one of the belly's broad sides to the other:
/// from that on which the origin lies, or, where neither lies aside, from either, turned around by the angle's sign.
/// The line of action runs as the harmonic field from origin to insertion.
std::vector<DirectionSample> pennate_directions(const SolidGrid& grid, const Muscle& muscle);

}  // namespace gracilis
