#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// One muscle's sections as they are in a frame. Corner i of section k is column k * rays + i.
struct SectionRings {
  Index rays = 0;
  Points centers;
  Points corners;  ///< those of all sections; without the two ends

  Index sections() const { return static_cast<Index>(centers.cols()); }          ///< their number
  auto corner(Index k, Index ray) { return corners.col(k * rays + ray); }        ///< m; may be written to
  Vec3 corner(Index k, Index ray) const { return corners.col(k * rays + ray); }  ///< m
};

/// Area of the triangle of the center, a corner and the next one, m².
Real triangle_area(const SectionRings& rings, Index section, Index ray);

/// Area about the center of the polygon that a section's corners make: the sum of its triangles, m².
Real section_area(const SectionRings& rings, Index section);

}  // namespace gracilis
