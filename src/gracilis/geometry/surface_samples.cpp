#include <gracilis/geometry/surface_samples.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/vertex_normals.hpp>

#include <vector>

namespace gracilis {

SurfaceSamples SurfaceSamples::kept(const std::function<bool(Index)>& keep) const {
  std::vector<Index> which;
  for (Index i = 0; i < count(); ++i)
    if (keep(i)) which.push_back(i);
  return {points(Eigen::all, which), normals(Eigen::all, which), areas(which)};
}

SurfaceSamples surface_samples(const TriangleMesh& mesh) {
  const SurfaceSamples all{mesh.vertices, vertex_normals(mesh.vertices, mesh.faces),
                           vertex_areas(mesh.vertices, mesh.faces)};
  return all.kept([&](Index i) { return all.normals.col(i).squaredNorm() > 0.5; });
}

}  // namespace gracilis
