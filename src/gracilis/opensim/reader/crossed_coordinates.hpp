#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <vector>

namespace gracilis::opensim {

/// The coordinates of the joints that lie between the bodies of a path's points and wrap objects: those that can change
/// its length. Ascending; of paths by functions, the functions' own.
std::vector<Index> crossed_coordinates(const Model& model, const Path& path);

/// The bodies that a muscle may lie on: those of a path's points, `more`, and those between them; ascending. Others may
/// move with one of them in some motion, and not in the next.
std::vector<Index> bodies_between(const Model& model, const Path& path, const std::vector<Index>& more = {});

}  // namespace gracilis::opensim
