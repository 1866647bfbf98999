#include <gracilis/io/mesh/load_surface.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/core/shell_word.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_pieces.hpp>
#include <gracilis/geometry/mesh_repair.hpp>

#include <fmt/format.h>

namespace gracilis {

static constexpr Real largest_diagonal = 5;       // m; nothing in a body is longer
static constexpr Real smallest_diagonal = 0.005;  // m; no muscle or bone we move is smaller
static constexpr Real crumb_share = 0.01;
static constexpr Real thinnest = 1e-6;  // m; what files in single precision lose of a place is a hundredth of it

/// "2 open edges" or "1 open edge".
static std::string counted(const MeshDefect& defect, const char* thing, const char* things) {
  return fmt::format("{} {}", defect.count, defect.count == 1 ? thing : things);
}

std::vector<Problem> fatal_problems(const MeshReport& report, Real unit, const std::string& file) {
  if (report.out_of_range_faces) {
    return {{file, fmt::format("face {}", report.out_of_range_faces.first),
             fmt::format("{} vertices that do not exist",
                         report.out_of_range_faces.count == 1 ? "names" : "is the first of several that name"),
             "export the surface again"}};
  }
  if (report.non_finite_vertices) {
    return {{file, fmt::format("vertex {}", report.non_finite_vertices.first),
             fmt::format("has a coordinate that is not finite ({} in all)",
                         counted(report.non_finite_vertices, "such vertex", "such vertices")),
             "export the surface again"}};
  }
  if (report.face_count == 0) return {{file, "", "holds no faces", "export a triangle surface"}};
  if (!(report.area > 0)) return {{file, "", "has no area: all its points lie on a line", "export the surface again"}};
  if (report.diagonal() > largest_diagonal) {
    return {{file, "",
             fmt::format("is {:.4g} m large, which no muscle or bone is: the unit is wrong", report.diagonal()),
             unit == 1 ? "set unit = \"mm\"" : "check the unit of the file"}};
  }
  if (report.diagonal() < smallest_diagonal) {
    return {
        {file, "",
         fmt::format("is {:.4g} mm large, too small for a muscle or bone: the unit is wrong", 1000 * report.diagonal()),
         unit == 1 ? "check the unit of the file" : "set unit = \"m\""}};
  }
  return {};
}

std::string with_part(const std::string& file, const std::string& part) {
  return part.empty() ? file : file + " (" + part + ")";
}

/// The command that mends a file, to be pasted; for surfaces from elsewhere its name stands as it is. What it writes no
/// longer has the unit that a scene says of the file.
static std::string mending(Real unit, const std::string& file, const std::string& part) {
  const char* in_unit = unit == 0.001 ? " --unit mm" : unit == 0.01 ? " --unit cm" : "";
  const std::string of_part = part.empty() ? "" : " --part " + shell_word(part);
  const char* then = unit == 1 ? "" : "; what that writes is in metres: leave out 'unit' for it, or set unit = \"m\"";
  return fmt::format("mend it with: gracilis prepare {}{}{} --out prepared{}", shell_word(file), of_part, in_unit,
                     then);
}

/// What is wrong with the surface's shape after repair: an error for a muscle, a warning for a bone.
static std::vector<Problem> shape_problems(const MeshReport& report, Real unit, const std::string& file,
                                           const std::string& part) {
  std::vector<Problem> problems;
  const auto add = [&](const MeshDefect& defect, const char* element, const std::string& what) {
    if (defect)
      problems.push_back(
          {with_part(file, part), fmt::format("{} {}", element, defect.first), what, mending(unit, file, part)});
  };
  add(report.open_edges, "face", "lies at a hole: " + counted(report.open_edges, "open edge", "open edges"));
  add(report.non_manifold_edges, "face",
      counted(report.non_manifold_edges, "edge has more than two faces", "edges have more than two faces"));
  add(report.pinched_vertices, "vertex",
      "joins parts of the surface in a point: " +
          counted(report.pinched_vertices, "pinched vertex", "pinched vertices"));
  add(report.inconsistent_edges, "face",
      "disagrees with a neighbor about inside and outside: " +
          counted(report.inconsistent_edges, "such edge", "such edges"));
  add(report.degenerate_faces, "face", "has no area: " + counted(report.degenerate_faces, "such face", "such faces"));
  return problems;
}

LoadedMesh check_surface(const TriangleMesh& mesh, Real unit, SurfaceRole role, const std::string& file,
                         const std::string& part) {
  const std::string name = with_part(file, part);
  const MeshReport as_read = inspect_mesh(mesh);
  if (const auto problems = fatal_problems(as_read, unit, name); !problems.empty()) throw InputError(problems);

  RepairedMesh repaired = repair_mesh(mesh, role == SurfaceRole::muscle ? crumb_share : 0);
  LoadedMesh loaded;
  loaded.mesh = std::move(repaired.mesh);
  loaded.report = inspect_mesh(loaded.mesh);
  for (const std::string& repair : repaired.repairs) loaded.repairs.push_back(name + ": " + repair);
  const std::vector<Problem> problems = shape_problems(loaded.report, unit, file, part);
  if (role == SurfaceRole::muscle && !problems.empty()) throw InputError(problems);
  // A muscle's fibers and sections divide by its thickness: twice its volume over its area.
  if (role == SurfaceRole::muscle &&
      !(2 * enclosed_volume(loaded.mesh.vertices, loaded.mesh.faces) > thinnest * loaded.report.area))
    throw InputError({name, "", "is flat: it encloses no volume", "export the surface again"});
  std::string flaws;
  for (const Problem& problem : problems)
    flaws += fmt::format("{}{}: {}", flaws.empty() ? "" : "; ", problem.where, problem.what);
  if (!flaws.empty()) loaded.warnings.push_back(name + ": " + flaws + " (tolerated in a bone)");
  return loaded;
}

LoadedMesh load_surface(const std::filesystem::path& path, Real unit, SurfaceRole role) {
  return check_surface(read_mesh(path, unit), unit, role, path.string());
}

std::vector<LoadOutcome> load_surfaces(const std::vector<SurfaceFile>& surfaces, MeshFiles& files) {
  std::vector<LoadOutcome> outcomes(surfaces.size());
  parallel_for_each(surfaces.size(), [&](std::size_t i) {
    try {
      const SurfaceFile& file = surfaces[i];
      const TriangleMesh mesh = files.read(file.path, file.unit, file.part);
      outcomes[i].loaded = check_surface(file.largest_piece ? largest_piece(mesh) : mesh, file.unit, file.role,
                                         file.path.string(), file.part);
    } catch (const InputError& error) {
      outcomes[i].error = error;
    }
  });
  return outcomes;
}

}  // namespace gracilis
