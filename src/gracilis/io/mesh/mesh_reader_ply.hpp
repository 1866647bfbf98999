#pragma once

#include <gracilis/io/mesh/polygon_mesh.hpp>

namespace gracilis {

/// Reads a .ply, ascii or binary of either byte order; properties other than x, y, z and the faces' indices are
/// skipped. VTK's own reader crashes on damaged files (out-of-range indices, missing bytes), hence this one.
PolygonMesh read_ply(const std::filesystem::path& path);

}  // namespace gracilis
