#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

namespace gracilis {

/// Area of the piece of a closed surface's section with a plane that lies around `point`, m²: of the closed lines that
/// the plane cuts out of the surface, the one whose middle is nearest to `point` counts, so that other parts of a bent
/// muscle do not. 0 where the plane misses the surface. `normal` is a unit vector.
Real cross_section_area(const TriangleMesh& surface, const MeshTopology& topology, const Vec3& point,
                        const Vec3& normal);

}  // namespace gracilis
