#include <gracilis/io/run/inspect_data.hpp>

#include <gracilis/anatomy/sections/surface_slices.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/mesh/likely_unit.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/scene/landmarks.hpp>
#include <gracilis/io/tables/table.hpp>

#include <nlohmann/json.hpp>

namespace gracilis {

using Json = nlohmann::ordered_json;

/// Defects that occur, with how often and where first.
static Json defects_of(const MeshReport& report) {
  Json defects = Json::array();
  const auto add = [&](const char* name, const char* element, const MeshDefect& defect) {
    if (defect)
      defects.push_back({{"defect", name}, {"count", defect.count}, {std::string("first_") + element, defect.first}});
  };
  add("vertices that do not exist", "face", report.out_of_range_faces);
  add("coordinates that are not finite", "vertex", report.non_finite_vertices);
  add("open edges", "face", report.open_edges);
  add("non-manifold edges", "face", report.non_manifold_edges);
  add("pinched vertices", "vertex", report.pinched_vertices);
  add("inconsistent edges", "face", report.inconsistent_edges);
  add("degenerate faces", "face", report.degenerate_faces);
  add("duplicate vertices", "vertex", report.duplicate_vertices);
  add("unreferenced vertices", "vertex", report.unreferenced_vertices);
  return defects;
}

/// Whether the surface can be used in this role, after which repairs, or why not.
static Json verdict(const TriangleMesh& mesh, Real unit, SurfaceRole role, const std::string& file) {
  try {
    const LoadedMesh loaded = check_surface(mesh, unit, role, file);
    Json verdict = {{"usable", true}};
    if (!loaded.repairs.empty()) verdict["repairs"] = loaded.repairs;
    if (!loaded.warnings.empty()) verdict["warnings"] = loaded.warnings;
    return verdict;
  } catch (const InputError& error) {
    Json reasons = Json::array();
    for (const Problem& problem : error.problems()) reasons.push_back(to_string(problem));
    return {{"usable", false}, {"reasons", reasons}};
  }
}

Json inspect_surface(const std::filesystem::path& path) {
  const TriangleMesh in_file_units = read_mesh(path, 1);
  const MeshReport report = inspect_mesh(in_file_units);
  const Vec3 size = report.high - report.low;
  const LengthUnit unit = likely_unit(size.maxCoeff());
  TriangleMesh mesh = in_file_units;
  mesh.vertices *= unit.length;
  return {{"kind", "surface"},
          {"vertices", report.vertex_count},
          {"triangles", report.face_count},
          {"unit_seems_to_be", unit.name},
          {"size", {size.x(), size.y(), size.z()}},
          {"lowest", {report.low.x(), report.low.y(), report.low.z()}},
          {"highest", {report.high.x(), report.high.y(), report.high.z()}},
          {"area", report.area},
          {"volume", report.is_closed() ? Json(report.volume) : Json()},
          {"closed", report.is_closed()},
          {"manifold", report.is_manifold()},
          {"consistently_oriented", report.is_oriented()},
          {"components", report.components},
          {"genus", report.genus < 0 ? Json() : Json(report.genus)},
          {"defects", defects_of(report)},
          {"as_muscle", verdict(mesh, unit.length, SurfaceRole::muscle, path.string())},
          {"as_bone", verdict(mesh, unit.length, SurfaceRole::bone, path.string())}};
}

Json inspect_slices(const std::filesystem::path& path, int count) {
  TriangleMesh mesh = read_mesh(path, 1);
  const MeshReport report = inspect_mesh(mesh);
  const Real to_mm = report.diagonal() > 5 ? 1 : 1000;
  Json slices = Json::array();
  for (const SurfaceSlice& slice : surface_slices(mesh, count)) {
    Json outline = Json::array();
    for (const auto& point : slice.outline.colwise()) outline.push_back({to_mm * point.x(), to_mm * point.y()});
    slices.push_back({{"place_mm", to_mm * slice.place},
                      {"outlines", slice.outlines},
                      {"area_mm2", to_mm * to_mm * slice.shape.area},
                      {"perimeter_mm", to_mm * slice.shape.perimeter},
                      {"isoperimetric_quotient", slice.shape.quotient},
                      {"convex", slice.shape.convex},
                      {"outline_mm", outline}});
  }
  return slices;
}

Json inspect_table(const std::filesystem::path& path) {
  const Table table = read_table(path);
  Json columns = Json::array();
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const auto values = table.values.col(static_cast<Eigen::Index>(i));
    columns.push_back({{"name", table.columns[i]}, {"from", values.minCoeff()}, {"to", values.maxCoeff()}});
  }
  return {{"kind", "table"},
          {"name", table.name},
          {"rows", table.times.size()},
          {"start_s", table.times.front()},
          {"end_s", table.times.back()},
          {"angles_in", table.in_degrees ? "degrees" : "radians"},
          {"columns", columns},
          {"warnings", table.warnings}};
}

Json inspect_landmarks(const std::filesystem::path& path) {
  Json clouds = Json::array();
  std::size_t total = 0;
  for (const LandmarkCloud& cloud : read_landmarks(path, 1)) {
    const Vec3 center = cloud.points.rowwise().mean();
    total += cloud.labels.size();
    clouds.push_back(
        {{"name", cloud.name}, {"points", cloud.labels.size()}, {"center", {center.x(), center.y(), center.z()}}});
  }
  return {{"kind", "landmarks"}, {"points", total}, {"unit", "m"}, {"clouds", clouds}};
}

}  // namespace gracilis
