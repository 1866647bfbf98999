#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/prepare/time_limit.hpp>

namespace gracilis {

/// Makes what is thinner than twice `radius` (m) that thick: where the largest ball that touches the surface from
/// inside is smaller, the surface moves outwards, its surroundings fading along. Threads become cords and blades blunt,
/// so that triangles of a given size can follow their round. A sheet, half of which is thinner than that, stays as
/// thin: `radius` is its median then. No vertex moves further than this in all. Returns the radius. The surface must be
/// closed and oriented outwards, and its vertices evenly spread.
Real thicken(TriangleMesh& mesh, Real radius, const TimeLimit& limit = TimeLimit());

/// Moves the surface in or out until it encloses `volume` (m³), to a ten thousandth of it where that is possible: each
/// vertex in proportion to the largest ball that touches the surface there from inside, up to the mean one, so that
/// bellies give what tendons and rims could not, and never by more than 0.4 of that ball's radius. The surface must be
/// closed and oriented outwards.
void set_volume(TriangleMesh& mesh, Real volume, const TimeLimit& limit = TimeLimit());

/// The same where the volume is off by more than a share, `tolerance`; a surface that it would spoil stays as it is.
void give_volume_back(TriangleMesh& mesh, Real volume, Real tolerance, const TimeLimit& limit);

}  // namespace gracilis
