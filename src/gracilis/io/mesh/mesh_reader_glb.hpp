#pragma once

#include <gracilis/io/mesh/polygon_mesh.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace gracilis {

/// A .glb file (glTF 2.0, everything in the one file) in memory, of which several parts are asked one after the other
/// or by several threads. Everything throws InputError.
class GlbFile {
 public:
  /// Reads the file.
  explicit GlbFile(const std::filesystem::path& path);
  ~GlbFile();
  GlbFile(const GlbFile&) = delete;
  GlbFile& operator=(const GlbFile&) = delete;

  /// The triangles, placed by the nodes; those of the node or mesh of this name and of the nodes below it, or all where
  /// it is empty. Compressed by Draco, too. Corners at the same place become one vertex: glTF splits them where normals
  /// or textures break. Lines, points, skins and morphs are left out. Refused are nodes that are no trees and meshes
  /// placed so often that the file could not honestly hold them: it would unpack to any size.
  PolygonMesh read(const std::string& part) const;

  /// Names by which `read` gives what is placed, one mesh each: that of the node, or of the mesh where the node has no
  /// name or others hang below it. In the file's order; what has no name is left out.
  std::vector<std::string> parts() const;

 private:
  struct Model;
  std::filesystem::path path_;
  std::unique_ptr<const Model> model_;
};

}  // namespace gracilis
