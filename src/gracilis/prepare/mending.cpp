#include <gracilis/prepare/mending.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/mesh_repair.hpp>
#include <gracilis/prepare/estimates.hpp>
#include <gracilis/prepare/rebuilding.hpp>
#include <gracilis/prepare/reshaping.hpp>
#include <gracilis/prepare/slivers.hpp>
#include <gracilis/prepare/solids.hpp>
#include <gracilis/prepare/thickness.hpp>

#include <utility>

namespace gracilis {

static constexpr Index grid_growth = 3;  ///< times as many triangles as there were

FixedSurface mended_surface(const TriangleMesh& mesh, const std::string& name, const PrepareSettings& settings) try {
  require_affordable({{name, mesh}}, {}, settings);
  const TimeLimit limit(settings.time_limit);
  FixedSurface fixed = fix_surface(mesh, name, limit);
  // Pieces that touch may have come to cut each other as each was mended by itself.
  if (cuts_itself(fixed.mesh, limit)) {
    TriangleMesh rebuilt = repair_mesh(rebuilt_as_solid(fixed.mesh, limit)).mesh;
    if (is_solid(rebuilt)) {
      fixed.mesh = std::move(rebuilt);
      fixed.repairs.push_back("rebuilt the surface from what it encloses, on a grid");
    }
  }
  if (settings.edge_length > 0 && fixed.mesh.face_count() > grid_growth * mesh.face_count()) {
    const Real volume = volume_of(fixed.mesh);
    fixed.mesh = coarsened(fixed.mesh, settings.edge_length, limit);
    give_volume_back(fixed.mesh, volume, settings.volume_tolerance, limit);
  }
  if (!fixed.repairs.empty()) drop_slivers(fixed.mesh, limit);
  for (TriangleMesh& head : fixed.heads) drop_slivers(head, limit);
  return fixed;
} catch (const OutOfTime&) {
  throw InputError(out_of_time(name, settings));
}

}  // namespace gracilis
