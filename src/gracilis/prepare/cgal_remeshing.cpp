#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/cgal_mesh.hpp>
#include <gracilis/prepare/solids.hpp>

#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <cstddef>
#include <exception>

namespace gracilis {
namespace {

/// To the nearest point of the surface as it was given; looks at the clock on the way.
struct WatchedProjection {
  CgalPoint operator()(CgalMesh::Vertex_index v) const {
    limit->check();
    const CgalPoint& p = surface->point(v);
    return to_cgal(given->query(Vec3(p.x(), p.y(), p.z())).point);
  }
  const CgalMesh* surface;
  const NearestTriangle* given;
  const TimeLimit* limit;
};

/// The surface's points; looks at the clock now and then, since millions of edges may be split between two projections.
struct WatchedPoints {
  using key_type = CgalMesh::Vertex_index;
  using value_type = CgalPoint;
  using reference = const CgalPoint&;
  using category = boost::read_write_property_map_tag;

  friend reference get(const WatchedPoints& points, key_type v) {
    if (++*points.looks % 4096 == 0) points.limit->check();
    return points.surface->point(v);
  }
  friend void put(const WatchedPoints& points, key_type v, const CgalPoint& p) { points.surface->point(v) = p; }

  CgalMesh* surface;
  const TimeLimit* limit;
  std::size_t* looks;
};

}  // namespace

std::optional<TriangleMesh> remesh_isotropic(const TriangleMesh& mesh, Real edge_length, int iterations,
                                             const TimeLimit& limit) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  if (!bounds_a_solid(inspect_mesh(mesh)) || mesh.face_count() < 4) return std::nullopt;
  std::optional<CgalMesh> given = to_cgal(mesh);
  if (!given) return std::nullopt;
  const NearestTriangle surface_given(mesh);
  std::size_t looks = 0;
  try {
    pmp::isotropic_remeshing(given->faces(), edge_length, *given,
                             CGAL::parameters::number_of_iterations(static_cast<unsigned>(iterations))
                                 .number_of_relaxation_steps(3)
                                 .vertex_point_map(WatchedPoints{&*given, &limit, &looks})
                                 .projection_functor(WatchedProjection{&*given, &surface_given, &limit}));
    given->collect_garbage();
    return from_cgal(*given);
  } catch (const Error&) {
    throw;
  } catch (const std::exception&) {
    return std::nullopt;  // CGAL says that it cannot
  }
}

}  // namespace gracilis
