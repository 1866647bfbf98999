#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <vector>

namespace gracilis::opensim {

/// The coordinates of the joints that lie between the bodies of a path's points and wrap objects: those that can change
/// its length. Ascending; of paths by functions, the functions' own.
std::vector<Index> crossed_coordinates(const Model& model, const Path& path);

}  // namespace gracilis::opensim
