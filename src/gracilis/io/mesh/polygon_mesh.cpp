#include <gracilis/io/mesh/polygon_mesh.hpp>

#include <gracilis/core/errors.hpp>

#include <fmt/format.h>

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolygon.h>

#include <limits>
#include <span>

namespace gracilis {

void PolygonMesh::add_strip(const std::vector<std::int64_t>& strip) {
  for (std::size_t i = 0; i + 2 < strip.size(); ++i) {
    const bool turned = i % 2 == 1;
    corners.insert(corners.end(), {strip[i], strip[i + (turned ? 2 : 1)], strip[i + (turned ? 1 : 2)]});
    end_polygon();
  }
}

using Corners = std::span<const std::int64_t>;

/// Cutting takes the square of the corners in time.
static constexpr std::size_t most_corners = 1000;

static void check_face(std::size_t face, Corners corners, Index vertex_count, const std::filesystem::path& path) {
  const auto fail = [&](const std::string& what) {
    throw InputError({path.string(), fmt::format("face {}", face), what, "export the surface again"});
  };
  if (corners.size() < 3) fail(fmt::format("has {} corners; a face needs three", corners.size()));
  if (corners.size() > most_corners)
    fail(fmt::format("has {} corners; {} are the most that are cut into triangles", corners.size(), most_corners));
  for (const std::int64_t corner : corners) {
    if (corner >= 0 && corner < vertex_count) continue;
    fail(fmt::format("names vertex {}, but the vertices go from 0 to {}", corner, vertex_count - 1));
  }
}

/// Cuts a polygon, also one that is not convex, into triangles; as a fan where it is too crooked for that.
static void cut(Corners corners, const Points& vertices, std::vector<Index>& triangles) {
  const auto count = static_cast<vtkIdType>(corners.size());
  vtkNew<vtkPolygon> polygon;
  bool finite = true;
  for (const std::int64_t corner : corners) {
    polygon->GetPointIds()->InsertNextId(corner);
    polygon->GetPoints()->InsertNextPoint(vertices.col(corner).data());
    finite = finite && vertices.col(corner).allFinite();
  }
  vtkNew<vtkIdList> cuts;
  if (!finite || !polygon->Triangulate(cuts) || cuts->GetNumberOfIds() != 3 * (count - 2)) {
    cuts->Reset();
    for (vtkIdType i = 1; i + 1 < count; ++i) {
      for (const vtkIdType k : {vtkIdType{0}, i, i + 1}) cuts->InsertNextId(k);
    }
  }
  for (vtkIdType i = 0; i < cuts->GetNumberOfIds(); ++i) {
    triangles.push_back(static_cast<Index>(corners[static_cast<std::size_t>(cuts->GetId(i))]));
  }
}

TriangleMesh triangulated(const PolygonMesh& polygons, Real unit, const std::filesystem::path& path) {
  const auto fail = [&](const char* what, const char* remedy) { throw InputError({path.string(), "", what, remedy}); };
  const std::size_t limit = std::numeric_limits<Index>::max() / 3;
  if (polygons.coordinates.empty()) fail("holds no vertices", "export the surface again");
  if (polygons.ends.empty()) {
    fail(!polygons.lines.empty() ? "holds lines but no surface" : "holds vertices but no faces",
         "export a triangle surface");
  }
  if (polygons.coordinates.size() / 3 > limit || polygons.corners.size() > limit) {
    fail("has too many vertices or faces", "decimate the surface");
  }

  TriangleMesh mesh;
  mesh.vertices = unit * Eigen::Map<const Points>(polygons.coordinates.data(), 3,
                                                  static_cast<Eigen::Index>(polygons.coordinates.size() / 3));
  std::vector<Index> triangles;
  triangles.reserve(polygons.corners.size());
  std::size_t begin = 0;
  for (std::size_t face = 0; face < polygons.ends.size(); ++face) {
    const Corners corners(polygons.corners.data() + begin, polygons.ends[face] - begin);
    begin = polygons.ends[face];
    check_face(face, corners, mesh.vertex_count(), path);
    if (corners.size() == 3) {
      for (const std::int64_t corner : corners) triangles.push_back(static_cast<Index>(corner));
    } else {
      cut(corners, mesh.vertices, triangles);
    }
  }
  mesh.faces = Eigen::Map<Eigen::Matrix3Xi>(triangles.data(), 3, static_cast<Eigen::Index>(triangles.size() / 3));
  return mesh;
}

}  // namespace gracilis
