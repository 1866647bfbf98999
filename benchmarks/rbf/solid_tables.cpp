#include "solids.hpp"
#include "tables.hpp"

#include <gracilis/io/mesh/mesh_reader.hpp>

#include <fmt/format.h>

#include <utility>

namespace gracilis {

void write_solids(const TableRequest& request) {
  std::vector<std::pair<std::string, TriangleMesh>> muscles = {{"built-in hip", builtin_gluteus()}};
  if (!request.thin && !request.data.empty())
    muscles.emplace_back("cadaver", read_mesh(request.data / "lhdl-hip/clean/gluteus_maximus_r.ply", 0.001));
  const std::vector<Real> shares =
      request.thin ? std::vector<Real>{0.05, 0.15} : std::vector<Real>{0.01, 0.025, 0.05, 0.1, 0.15};
  std::ofstream table = request.table(
      "solids", "muscle,vertices,centers,share_percent,volume_error_percent,hausdorff_mm,mean_mm,condition");
  for (const auto& [name, surface] : muscles)
    for (const Real share : shares) {
      const auto count = static_cast<Index>(share * surface.vertex_count());
      const SolidErrors errors = solid_errors(surface, count, request.thin ? 0.005 : 0.003);
      table << fmt::format("{},{},{},{:.4g},{:.4g},{:.4g},{:.4g},{:.3g}\n", name, surface.vertex_count(), count,
                           100 * share, 100 * errors.volume, 1000 * errors.hausdorff, 1000 * errors.mean,
                           errors.condition);
    }
}

}  // namespace gracilis
