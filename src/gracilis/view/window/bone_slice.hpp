#pragma once

#include <gracilis/geometry/distance_field.hpp>
#include <gracilis/view/window/glyphs.hpp>
#include <gracilis/view/window/shape_history.hpp>
#include <gracilis/view/window/window_state.hpp>

#include <vector>

namespace gracilis {

/// Distances to the nearest bone on a plane, from the bones' distance fields; blue outside, red inside, dark at the
/// surface, and nothing farther away than the scale reaches.
ColoredMesh bone_slice(const ShownShapes& shapes, const ShownFrame& frame, const std::vector<DistanceField>& fields,
                       Slice plane, Real at);

/// The scale of its colors: signed distance, m.
const ColorScale& slice_scale();

}  // namespace gracilis
