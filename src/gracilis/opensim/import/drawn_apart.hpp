#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis::opensim {

/// A closed surface of sections with as many corners each: the corners of the first section, of the second and so on,
/// then a point at either end, as cylinder surfaces have them.
struct SectionedSurface {
  TriangleMesh surface;
  Points centers;  ///< of the sections, m
};

/// Draws corners in toward the centers of their sections until no surface has a vertex in another, but for what is left
/// after 20 rounds or would take more than 6 tenths of a corner's distance from its center. Of what two overlap by,
/// each gives as much as it is thick there, so that a tendon keeps its shape in a belly that makes way for it. First
/// and last sections stay, as they are held by bones.
void draw_apart(std::vector<SectionedSurface>& muscles);

}  // namespace gracilis::opensim
