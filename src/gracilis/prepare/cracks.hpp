#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

namespace gracilis {

/// Closes cracks: vertices at open edges that lie nearer to each other than a distance become one. That distance grows
/// from a ten thousandth to a fifth of the mean edge, and what leaves the fewest open edges counts. Neighbors along an
/// edge stay apart. Returns how many vertices went; where the open edges do not get fewer by half none do, for what is
/// open then are holes. No face of the result names a vertex twice.
Index close_cracks(TriangleMesh& mesh);

}  // namespace gracilis
