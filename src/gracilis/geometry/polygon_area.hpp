#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// Area of a polygon times the normal about which its corners go around, m²: of one that is not flat, that of its
/// projection along this. Precondition: a corner or more.
Vec3 polygon_area_vector(const Points& corners);

}  // namespace gracilis
