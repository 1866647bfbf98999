#pragma once

#include <gracilis/io/mesh/polygon_mesh.hpp>

namespace gracilis {

/// Reads the polygons and strips of a legacy .vtk file with a POLYDATA set, ascii or binary, versions 1 to 5.1.
/// Everything from POINT_DATA or CELL_DATA on is left unread. VTK's own reader crashes on files that end early, hence
/// this one.
PolygonMesh read_legacy_vtk(const std::filesystem::path& path);

}  // namespace gracilis
