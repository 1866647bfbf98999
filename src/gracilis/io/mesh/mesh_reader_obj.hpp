#pragma once

#include <gracilis/io/mesh/polygon_mesh.hpp>

namespace gracilis {

/// Reads the vertices and faces of a .obj; materials, normals, texture coordinates, groups and lines are skipped.
/// Vertices keep the file's order and number, which VTK's reader does not promise where faces name normals; nor does it
/// notice letters in a number.
PolygonMesh read_obj(const std::filesystem::path& path);

}  // namespace gracilis
