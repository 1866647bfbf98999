#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace gracilis {

/// Reads the surface in a .ply, .stl, .obj, .vtk (legacy), .vtp or .glb file, chosen by extension in any case; `unit`
/// is the length of the file's unit in m, `part` the node or mesh of a .glb that is wanted alone. Vertices keep the
/// file's order (an .stl and a .glb have none: their equal corners become one vertex); polygons and strips are cut into
/// triangles, lines and single points are left out. Indices lie within the vertices; nothing else is checked. Throws
/// InputError when the file cannot be read, is damaged or holds no triangle.
TriangleMesh read_mesh(const std::filesystem::path& path, Real unit, const std::string& part = {});

/// The same of several parts of files: a .glb is read from the disk once. Any thread may ask.
class MeshFiles {
 public:
  MeshFiles();
  ~MeshFiles();
  MeshFiles(const MeshFiles&) = delete;
  MeshFiles& operator=(const MeshFiles&) = delete;

  /// As read_mesh.
  TriangleMesh read(const std::filesystem::path& path, Real unit, const std::string& part = {});

  /// Names of the meshes that a .glb places (GlbFile::parts); none of any other file.
  std::vector<std::string> parts(const std::filesystem::path& path);

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

}  // namespace gracilis
