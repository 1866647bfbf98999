#pragma once

#include <gracilis/scene/scene.hpp>

namespace gracilis {

/// The method that follows sliders in the page at first: `xpbd` with few iterations, since steps are small there (1.25
/// degrees) and each goes on from the last; by the preset `fast` where most muscles' triangles are so much smaller than
/// those of its copies that copies are worth what it takes to go to them and back.
MethodChoice page_method(const Scene& scene);

}  // namespace gracilis
