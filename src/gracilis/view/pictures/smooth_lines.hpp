#pragma once

#include <gracilis/geometry/polylines.hpp>

namespace gracilis {

/// Lines as they are drawn: corners are rounded (points move to the mean of their neighbors and themselves, ends stay)
/// and each part is drawn as four along a curve through its points (Catmull and Rom 1974). Lines of fewer than three
/// points stay as they are.
Polylines smooth_lines(const Polylines& lines);

}  // namespace gracilis
