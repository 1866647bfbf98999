#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <filesystem>

namespace gracilis {

/// Reads the surface in a .ply, .stl, .obj, .vtk (legacy) or .vtp file, chosen by extension in any case; `unit` is the
/// length of the file's unit in m. Vertices keep the file's order (an .stl has none: its equal corners become one
/// vertex); polygons and strips are cut into triangles, lines and single points are left out. Indices lie within the
/// vertices; nothing else is checked. Throws InputError when the file cannot be read, is damaged or holds no triangle.
TriangleMesh read_mesh(const std::filesystem::path& path, Real unit);

}  // namespace gracilis
