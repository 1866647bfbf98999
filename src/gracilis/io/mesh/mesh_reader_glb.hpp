#pragma once

#include <gracilis/io/mesh/polygon_mesh.hpp>

#include <filesystem>
#include <string>

namespace gracilis {

/// The triangles of a .glb file (glTF 2.0, everything in the one file), placed by its nodes; those of the node or mesh
/// of this name and of the nodes below it, or all where it is empty. Compressed by Draco, too. Corners at the same
/// place become one vertex: glTF splits them where normals or textures break. Lines, points, skins and morphs are left
/// out. Throws InputError.
PolygonMesh read_glb(const std::filesystem::path& path, const std::string& part);

}  // namespace gracilis
