#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/view/pictures/picture.hpp>

#include <vector>

namespace gracilis {

/// One muscle, seen through, with its fibers, from three sides.
Picture muscle_fiber_picture(const Muscle& muscle, const Polylines& fibers, const Color& color);

/// The bones with the fibers of all muscles (one entry per muscle), from four sides.
Picture all_fibers_picture(const Scene& scene, const std::vector<Polylines>& fibers);

}  // namespace gracilis
