#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace gracilis {

/// A surface as files hold it: polygons of any size, indices not yet checked.
struct PolygonMesh {
  std::vector<double> coordinates;               ///< x y z x y z ...
  std::vector<std::int64_t> corners;             ///< of all polygons, one after the other
  std::vector<std::size_t> ends;                 ///< per polygon: where its corners end
  std::vector<std::vector<std::int64_t>> lines;  ///< the points of each polyline; no part of the surface

  /// Ends the polygon whose corners were just added.
  void end_polygon() { ends.push_back(corners.size()); }
  /// Adds the triangles of a strip; every second one is turned around, as strips want it.
  void add_strip(const std::vector<std::int64_t>& strip);
};

/// Cuts polygons into triangles and multiplies the coordinates by `unit`. Throws InputError naming the face when it has
/// fewer than three corners or an index outside the vertices, and when there is no vertex or no face at all.
TriangleMesh triangulated(const PolygonMesh& polygons, Real unit, const std::filesystem::path& path);

}  // namespace gracilis
