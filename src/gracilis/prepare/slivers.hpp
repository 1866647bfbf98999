#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/prepare/time_limit.hpp>

namespace gracilis {

/// Takes away edges that are far shorter than the others, as come about where pieces are united or holes are filled: by
/// collapse, or, where that cannot be, by cutting them out and filling the hole. No method can tell how an edge of a
/// micrometre stretches. The surface stays a solid that does not cut itself; where it would, short edges stay.
/// Precondition: a solid (solids.hpp) that does not cut itself.
void drop_slivers(TriangleMesh& mesh, const TimeLimit& limit);

}  // namespace gracilis
