#pragma once

#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/prepare/time_limit.hpp>

namespace gracilis {

/// Closed, manifold and oriented: it tells inside from outside.
bool bounds_a_solid(const MeshReport& report);

/// And every triangle has an area.
bool is_solid(const MeshReport& report);

/// And oriented outwards: of one piece or more.
bool is_solid(const TriangleMesh& mesh);

/// What a closed surface encloses, m³; see enclosed_volume (geometry/measures.hpp).
Real volume_of(const TriangleMesh& mesh);

/// By which share of `volume` (m³) what a closed surface encloses differs from it.
Real volume_error(const TriangleMesh& mesh, Real volume);

/// Whether any two triangles intersect but where they are neighbors. Throws OutOfTime.
bool cuts_itself(const TriangleMesh& mesh, const TimeLimit& limit);

}  // namespace gracilis
