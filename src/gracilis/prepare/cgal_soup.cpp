#include <gracilis/geometry/mesh_repair.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/cgal_mesh.hpp>
#include <gracilis/prepare/sheets.hpp>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>

#include <array>
#include <exception>

namespace gracilis {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

struct Soup {
  explicit Soup(const TriangleMesh& mesh) {
    for (Index v = 0; v < mesh.vertex_count(); ++v) points.push_back(to_cgal(mesh.vertices.col(v)));
    for (Index f = 0; f < mesh.face_count(); ++f) {
      std::vector<std::size_t>& polygon = polygons.emplace_back();
      for (int k = 0; k < 3; ++k) polygon.push_back(static_cast<std::size_t>(mesh.faces(k, f)));
    }
  }

  TriangleMesh mesh() const {
    TriangleMesh mesh;
    mesh.vertices.resize(3, static_cast<Index>(points.size()));
    for (std::size_t v = 0; v < points.size(); ++v)
      mesh.vertices.col(static_cast<Index>(v)) << points[v].x(), points[v].y(), points[v].z();
    mesh.faces.resize(3, static_cast<Index>(polygons.size()));
    Index count = 0;
    for (const auto& polygon : polygons) {
      if (polygon.size() != 3) continue;
      for (int k = 0; k < 3; ++k) mesh.faces(k, count) = static_cast<Index>(polygon[static_cast<std::size_t>(k)]);
      ++count;
    }
    mesh.faces.conservativeResize(3, count);
    return mesh;
  }

  std::vector<CgalPoint> points;
  std::vector<std::vector<std::size_t>> polygons;
};

}  // namespace

TriangleMesh manifold_of_soup(const TriangleMesh& mesh) {
  try {
    Soup soup(mesh);
    // A wall between two solids is there twice, once for each.
    pmp::repair_polygon_soup(soup.points, soup.polygons,
                             CGAL::parameters::geom_traits(CgalKernel()).require_same_orientation(true));
    Soup sheets(separate_sheets(repair_mesh(soup.mesh()).mesh));
    pmp::orient_polygon_soup(sheets.points, sheets.polygons);
    return sheets.mesh();
  } catch (const std::exception&) {
    return {};  // CGAL says that it cannot
  }
}

}  // namespace gracilis
