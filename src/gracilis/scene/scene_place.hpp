#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/scene/scene.hpp>

namespace gracilis {

/// About where a box lies in its frame: its middle, rounded to whole multiples of 8 m, so that it is zero near the
/// origin and costs no digits when it is taken off. About such a place single precision tells less than a micrometre.
Vec3 place_of(const Eigen::AlignedBox3d& box);

/// About where all bones and muscles of a scene lie.
Vec3 place_of(const Scene& scene);

/// The same scene, all of it shifted.
Scene shifted(Scene scene, const Vec3& by);

}  // namespace gracilis
