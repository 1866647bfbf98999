#pragma once

#include <gracilis/methods/tissue/factored_matrix.hpp>
#include <gracilis/methods/tissue/minimize.hpp>
#include <gracilis/methods/tissue/total_energy.hpp>

namespace gracilis::tissue {

/// Takes a muscle to the least energy near its nodes, in so many iterations at most, and looks now and then what bones
/// are near.
Minimized settle(const PreparedTissue& muscle, Surroundings& around, const FactoredMatrix& metric, int iterations,
                 Points& nodes);

}  // namespace gracilis::tissue
