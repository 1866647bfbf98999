#include <gracilis/io/mesh/mesh_reader.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh/mesh_reader_glb.hpp>
#include <gracilis/io/mesh/mesh_reader_obj.hpp>
#include <gracilis/io/mesh/mesh_reader_ply.hpp>
#include <gracilis/io/mesh/mesh_reader_vtk.hpp>
#include <gracilis/io/mesh/mesh_reader_vtp.hpp>
#include <gracilis/io/mesh/vtk_messages.hpp>

#include <fmt/format.h>

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtksys/SystemTools.hxx>

#include <cstring>
#include <map>
#include <mutex>
#include <new>
#include <string>

namespace gracilis {

namespace fs = std::filesystem;

[[noreturn]] static void throw_read_error(const fs::path& path, const std::string& what,
                                          const std::string& remedy = "export the surface again") {
  throw InputError({path.string(), "", what, remedy});
}

/// VTK believes any file that is no text to be a binary .stl and takes from it what it can; a whole one has 84 bytes
/// and 50 for each triangle it announces.
static void require_whole_stl(const fs::path& path) {
  const std::string bytes = read_text(path);
  const bool vtk_reads_text = vtksys::SystemTools::DetectFileType(path.c_str()) == vtksys::SystemTools::FileTypeText;
  const bool text = vtk_reads_text && bytes.starts_with("solid") && bytes.find("facet") != std::string::npos;
  std::uint32_t triangles = 0;
  if (bytes.size() >= 84) std::memcpy(&triangles, bytes.data() + 80, sizeof triangles);
  const std::size_t expected = 84 + 50 * std::size_t{triangles};
  if (text && bytes.size() != expected && bytes.find("endsolid") == std::string::npos)
    throw_read_error(path, "ends before 'endsolid'");
  if (text || bytes.size() == expected) return;
  if (bytes.size() < 84 || bytes.starts_with("solid"))
    throw_read_error(path, "is neither a text nor a binary .stl file");
  throw_read_error(
      path, fmt::format("announces {} triangles, which takes {} bytes, but has {}", triangles, expected, bytes.size()));
}

/// VTK's reader drops triangles whose corners coincide.
static PolygonMesh read_stl(const fs::path& path) {
  require_whole_stl(path);
  VtkMessages messages;
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  if (messages.has_errors()) throw_read_error(path, "is damaged or no .stl file: " + messages.first_error());
  vtkPolyData& data = *reader->GetOutput();
  PolygonMesh mesh;
  mesh.coordinates.resize(3 * static_cast<std::size_t>(data.GetNumberOfPoints()));
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) data.GetPoint(i, mesh.coordinates.data() + 3 * i);
  for (vtkIdType i = 0; i < data.GetNumberOfPolys(); ++i) {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    data.GetPolys()->GetCellAtId(i, size, corners);
    mesh.corners.insert(mesh.corners.end(), corners, corners + size);
    mesh.end_polygon();
  }
  return mesh;
}

struct MeshFiles::Kept {
  std::mutex mutex;
  std::map<fs::path, std::unique_ptr<const GlbFile>> glb;

  const GlbFile& file(const fs::path& path) {
    const std::lock_guard lock(mutex);
    std::unique_ptr<const GlbFile>& known = glb[path];
    if (!known) known = std::make_unique<const GlbFile>(path);
    return *known;
  }
};

MeshFiles::MeshFiles() : kept_(std::make_unique<Kept>()) {}
MeshFiles::~MeshFiles() = default;

static PolygonMesh read_polygons(const fs::path& path, const std::string& part) {
  const std::string extension = lower_case_extension(path);
  if (!part.empty())
    throw_read_error(path, "has no parts that a name could choose", "leave 'part' out, or give a .glb");
  if (extension == ".ply") return read_ply(path);
  if (extension == ".obj") return read_obj(path);
  if (extension == ".vtk") return read_legacy_vtk(path);
  if (extension == ".vtp") return read_vtp(path);
  if (extension == ".stl") return read_stl(path);
  throw_read_error(path, fmt::format("'{}' is not a mesh format that can be read", extension),
                   "use .ply, .stl, .obj, .vtk, .vtp or .glb");
}

static bool is_glb(const fs::path& path) { return lower_case_extension(path) == ".glb"; }

TriangleMesh MeshFiles::read(const fs::path& path, Real unit, const std::string& part) {
  require_readable_file(path);
  try {
    if (!is_glb(path)) return triangulated(read_polygons(path, part), unit, path);
    return triangulated(kept_->file(path).read(part), unit, path);
  } catch (const std::bad_alloc&) {
    throw_read_error(path, "needs more memory than there is: the machine is short of it, or the file is damaged",
                     "close other programs, or export the surface again");
  } catch (const std::length_error&) {
    throw_read_error(path, "announces more data than memory can hold: the file is damaged");
  }
}

std::vector<std::string> MeshFiles::parts(const fs::path& path) {
  if (!is_glb(path)) return {};
  require_readable_file(path);
  return kept_->file(path).parts();
}

TriangleMesh read_mesh(const fs::path& path, Real unit, const std::string& part) {
  return MeshFiles().read(path, unit, part);
}

}  // namespace gracilis
