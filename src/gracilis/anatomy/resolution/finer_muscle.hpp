#pragma once

#include <gracilis/scene/scene.hpp>

namespace gracilis {

/// The same muscle with every triangle divided into four by the middles of its edges; its shape does not change. A
/// middle is attached where both of its edge's ends are. Fibers that were given stay as they are.
Muscle finer_muscle(const Muscle& muscle);

}  // namespace gracilis
