#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// What a surface is read for; decides what is tolerated in it.
enum class SurfaceRole {
  muscle,  ///< must be closed, manifold and in one piece
  bone     ///< may be open, non-manifold and in several pieces, with a warning: OpenSim's own bones are
};

/// A surface ready for use, and what there is to say about it.
struct LoadedMesh {
  TriangleMesh mesh;                  ///< m; exactly the file's when nothing had to be repaired
  MeshReport report;                  ///< of `mesh`
  std::vector<std::string> repairs;   ///< one sentence each, beginning with the file's path
  std::vector<std::string> warnings;  ///< the same
};

/// Reads, inspects and repairs a surface; `unit` is the length of the file's unit in m. Pieces of a muscle with less
/// than 1 % of its area are dropped as crumbs. Throws InputError listing all that cannot be repaired or tolerated in
/// this role, each with file, element and remedy; also when the bounding box shows that `unit` is wrong (a diagonal
/// above 5 m or below 5 mm).
LoadedMesh load_surface(const std::filesystem::path& path, Real unit, SurfaceRole role);

/// A file and what its surface is for.
struct SurfaceFile {
  std::filesystem::path path;
  Real unit = 1;  ///< length of the file's unit, m
  SurfaceRole role = SurfaceRole::muscle;
  bool largest_piece = false;  ///< only the piece that encloses most
  std::string part = {};       ///< as in read_mesh
};
/// What load_surface answers with or throws.
struct LoadOutcome {
  LoadedMesh loaded;
  std::optional<InputError> error = {};
};

/// Loads several surfaces at the same time; answers in their order.
std::vector<LoadOutcome> load_surfaces(const std::vector<SurfaceFile>& surfaces, MeshFiles& files);

/// What makes a surface useless in any role, mended or not: no faces, no area, coordinates that are not finite, or a
/// size that shows that `unit` is wrong. `file` stands in messages.
std::vector<Problem> fatal_problems(const MeshReport& report, Real unit, const std::string& file);

/// "file", or "file (part)": how messages name a surface.
std::string with_part(const std::string& file, const std::string& part);

/// The same checks for a surface already in memory, whatever its origin; `file`, of a .glb with its part, names it in
/// messages.
LoadedMesh check_surface(const TriangleMesh& mesh, Real unit, SurfaceRole role, const std::string& file,
                         const std::string& part = {});

}  // namespace gracilis
