#pragma once

#include <gracilis/geometry/needles.hpp>
#include <gracilis/scene/scene.hpp>

#include <array>
#include <vector>

namespace gracilis {

/// Vertices that came into a muscle's surface after its own, each half-way between two others.
struct VerticesBetween {
  Index first = 0;                         ///< the first of them, which is how many the surface had
  std::vector<std::array<Index, 2>> ends;  ///< what each lies between
};

/// Divides the needles of those muscles whose surfaces are made of them (geometry/needles.hpp), before they are
/// attached. Those with an action line are left: their surfaces are sections, corner by corner. Returns what came into
/// each.
std::vector<VerticesBetween> divide_needles(std::vector<Muscle>& muscles);

/// Adds to vertices, behind them, those new ones that lie between two of them and are not there yet.
void add_vertices_between(const VerticesBetween& added, std::vector<Index>& vertices);

}  // namespace gracilis
