#pragma once

#include <gracilis/core/types.hpp>

#include <array>
#include <string_view>
#include <vector>

namespace gracilis {

/// Ways to put points that lie around an area on a surface, in any order, into the order of its outline. Those in the
/// plane see the points along the normal of the plane that fits them best.
enum class OutlineCurve {
  nearest_neighbor,  ///< always on to the nearest point that is left
  nn_crust,          ///< nearest neighbor on both sides of each point (Dey and Kumar 1999)
  crust,             ///< edges that no Voronoi vertex separates (Amenta, Bern and Eppstein 1998); in the plane
  beta_skeleton,     ///< edges with nothing beside them (Kirkpatrick and Radke 1985)
  alpha_shape,       ///< rim of the Delaunay triangles that a disk does not fit between (Edelsbrunner et al. 1983); in
                     ///< the plane
  spanning_tree,     ///< shortest tree (de Figueiredo and de Miranda Gomes 1994)
  shortest_tour,     ///< shortest closed way through all points (Giesen 1999), improved until no exchange helps
  angular            ///< around the middle, by angle; in the plane
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 8> choices_of(OutlineCurve) {
  return {"nearest-neighbor", "nn-crust",      "crust",         "beta-skeleton",
          "alpha-shape",      "spanning-tree", "shortest-tour", "angular"};
}

/// The numbers of all points in the order of a closed outline through them. What a way of doing it leaves apart is
/// joined by the shortest links between ends. Precondition: finite points; with fewer than three any order is an
/// outline.
std::vector<Index> outline_order(OutlineCurve curve, const Points& points);

/// The points in that order.
Points ordered_outline(OutlineCurve curve, const Points& points);

}  // namespace gracilis
