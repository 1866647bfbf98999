#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/prepare/pieces.hpp>
#include <gracilis/prepare/time_limit.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// A surface made closed, manifold and oriented, and what that took; clauses such as "filled 1 hole".
struct FixedSurface {
  TriangleMesh mesh;
  std::vector<std::string> repairs;
  std::vector<TriangleMesh> heads = {};  ///< closed pieces of which it was united, where they may be a muscle's heads
};

/// Repairs any triangle surface, in this order: what geometry/mesh_repair.hpp does; where that is not enough, equal
/// vertices are merged, doubled faces dropped and sheets that meet in a vertex or an edge separated. Then each
/// connected piece: with less than a hundredth of the area it is dropped, and where it encloses nothing; holes are
/// filled; faces turned outwards; where it cuts itself that is cut out and filled, and where this fails it is rebuilt
/// from what it encloses. Pieces that lie in another one are dropped, those that cut each other united. A sound surface
/// comes back as it is. Throws InputError naming `name` when nothing of it encloses a volume, and OutOfTime.
FixedSurface fix_surface(const TriangleMesh& mesh, const std::string& name, const TimeLimit& limit = TimeLimit());

}  // namespace gracilis
