#pragma once

#include <gracilis/geometry/thin_plate.hpp>
#include <gracilis/transfer/skeleton_fit.hpp>

namespace gracilis {

/// The map of all space that bends least and takes each registered bone about to where it was laid: what carries
/// everything that is no bone.
ThinPlateMap space_warp(const Scene& scene, const SkeletonFit& fit);

}  // namespace gracilis
