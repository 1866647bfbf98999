#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/prepare/time_limit.hpp>
#include <gracilis/scene/settings.hpp>

#include <functional>
#include <string>

namespace gracilis {

/// Edges about as long as asked for, none far from it, no needles: remeshing would only blur the surface.
bool has_edges_about(const TriangleMesh& mesh, Real length);

/// A closed surface in triangles of the size asked for, each piece by itself. What they could not follow, threads and
/// blades, is rounded while the triangles are still half as large; what that adds to the volume is taken off again
/// (`PrepareSettings::volume_tolerance`), with smaller triangles where it must be. Tells on `say` what it could not do.
TriangleMesh reshaped(const TriangleMesh& mesh, const PrepareSettings& settings, const TimeLimit& limit,
                      const std::function<void(const std::string&)>& say);

/// Fewer triangles of a closed surface, down to those of edges as long as asked for: as few as it has without cutting
/// itself. The surface stays within what its own triangles tell.
TriangleMesh coarsened(const TriangleMesh& mesh, Real edge_length, const TimeLimit& limit);

/// The same triangles' size without rounding: again after surfaces were moved.
TriangleMesh remeshed(const TriangleMesh& mesh, const PrepareSettings& settings, const TimeLimit& limit);

/// Edges at which the surface turns by more than this are rounded, and counted in reports.
inline constexpr Real sharpest_turn = radians(80);

}  // namespace gracilis
