#pragma once

#include <gracilis/io/polygon_mesh.hpp>

namespace gracilis {

/// Reads the polygons and strips of a .vtp: ascii, binary and appended arrays of any type, compressed or not, in any
/// number of pieces. VTK's own reader crashes on damaged block sizes, hence this one.
PolygonMesh read_vtp(const std::filesystem::path& path);

}  // namespace gracilis
