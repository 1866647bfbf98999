#pragma once

#include <gracilis/anatomy/overlap/rest_overlap.hpp>

#include <vector>

namespace gracilis {

/// Whether two surfaces that overlap can be taken apart. What lies inside hangs together in regions; a region has a
/// side when the shortest ways out of all its vertices lead about the same way, and it does not cut its surface into
/// pieces, as it would where that passes through the other.
struct OverlapSides {
  std::vector<Real> first_astray, second_astray;  ///< per vertex: how deep the region without a side is that it lies
                                                  ///< in, or that cuts it off, m; 0 elsewhere
  Points first_ways, second_ways;  ///< per vertex: of its region the mean of the ways out, unit; 0 without a side
  bool is_through = false;  ///< neither surface has a side for at least half of what of its belly lies inside: one
                            ///< passes through the other
};

/// One of the two surfaces of an overlap.
struct OverlappingSurface {
  const TriangleMesh& mesh;
  const std::vector<char>& in_tendon;  ///< per vertex; empty: none. That a tendon runs through a belly, or within
                                       ///< another tendon, does not keep bellies from being taken apart
};

/// Precondition: the overlap is that of these two surfaces, in this order.
OverlapSides overlap_sides(const RestOverlap& overlap, const OverlappingSurface& first,
                           const OverlappingSurface& second);

}  // namespace gracilis
