#include <gracilis/prepare/surface_repair.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/mesh_repair.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/cracks.hpp>
#include <gracilis/prepare/cut_and_fill.hpp>
#include <gracilis/prepare/rebuilding.hpp>
#include <gracilis/prepare/solids.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gracilis {
namespace {

/// Volume over area to the power 3/2: 0.09 for a ball, 0.002 for a sheet of 2 mm of a hand's size. Less is no solid.
constexpr Real flattest = 5e-5;
constexpr Real crumb_share = 0.01;    ///< of the area; smaller pieces go
constexpr Real least_area = 0.6;      ///< share that should be left of a surface
constexpr Real least_volume = 0.002;  ///< share of all pieces'; less is a crumb, whatever its area
/// Share of an open piece's area that its area vectors sum up to: all of it where it is flat, of half a ball a half.
constexpr Real least_one_way = 2.0 / 3;

std::string counted(Index count, const std::string& thing, const std::string& things) {
  return std::to_string(count) + " " + (count == 1 ? thing : things);
}

bool is_flat(const MeshReport& report) { return !(report.volume > flattest * std::pow(report.area, 1.5)); }

void take(RepairedMesh repaired, FixedSurface& fixed) {
  fixed.mesh = std::move(repaired.mesh);
  for (const std::string& repair : repaired.repairs) fixed.repairs.push_back(repair);
}

/// Without crumbs, unless most of it is crumbs: triangles of their own, for example.
RepairedMesh without_crumbs(const TriangleMesh& mesh) {
  RepairedMesh repaired = repair_mesh(mesh, crumb_share);
  const auto area = [](const TriangleMesh& each) { return surface_area(each.vertices, each.faces); };
  return area(repaired.mesh) < least_area * area(mesh) ? repair_mesh(mesh) : repaired;
}

/// Only faces count: vertices that no face names are left behind.
void make_manifold(FixedSurface& fixed) {
  const MeshReport before = inspect_mesh(fixed.mesh);
  fixed.mesh = manifold_of_soup(fixed.mesh);
  if (before.non_manifold_edges)
    fixed.repairs.push_back("separated the sheets at " + counted(before.non_manifold_edges.count, "edge", "edges") +
                            " with more than two faces");
  if (before.pinched_vertices)
    fixed.repairs.push_back("separated the parts that met at " +
                            counted(before.pinched_vertices.count, "vertex", "vertices"));
  if (!before.non_manifold_edges && !before.pinched_vertices)
    fixed.repairs.push_back("rebuilt how the faces hang together");
  if (const Index joined = close_cracks(fixed.mesh); joined > 0) {
    fixed.repairs.push_back("closed cracks at " + counted(joined, "vertex", "vertices"));
    fixed.mesh = manifold_of_soup(fixed.mesh);
  }
}

/// What was done to all pieces together.
struct Tally {
  Index filled = 0, flat = 0, sheets = 0, tiny = 0, mended = 0, rebuilt = 0, nested = 0;
};

/// A piece without holes.
struct ClosedPiece {
  TriangleMesh mesh;
  bool was_sheet = false;
};

/// Whether most of an open piece looks one way: a sheet, which has no inside.
bool is_sheet(const TriangleMesh& piece, const MeshReport& report) {
  Vec3 sum = Vec3::Zero();
  for (const Eigen::Vector3i face : piece.faces.colwise()) sum += area_vector(piece.vertices, face);
  return report.open_edges && sum.norm() / 2 > least_one_way * report.area;
}

/// Closes one piece; empty where that cannot be, or where nothing is enclosed.
ClosedPiece closed_piece(TriangleMesh piece, Tally& tally, const TimeLimit& limit) {
  MeshReport report = inspect_mesh(piece);
  const bool was_sheet = is_sheet(piece, report);
  if (report.open_edges) {
    const Index filled = fill_holes(piece, std::numeric_limits<Real>::max(), true, limit);
    tally.filled += filled;
    report = inspect_mesh(piece = repair_mesh(piece).mesh);
  }
  if (!is_solid(report) || report.volume < 0) report = inspect_mesh(piece = repair_mesh(piece).mesh);
  if (!is_solid(report) || is_flat(report)) {
    ++tally.flat;
    return {};
  }
  return {std::move(piece), was_sheet};
}

/// Sheets beside a larger solid: what closing them encloses is made up. Returns how many.
Index drop_sheets(std::vector<ClosedPiece>& pieces) {
  Real largest = 0;
  for (const ClosedPiece& piece : pieces)
    if (!piece.was_sheet) largest = std::max(largest, volume_of(piece.mesh));
  return static_cast<Index>(std::erase_if(
      pieces, [&](const ClosedPiece& piece) { return piece.was_sheet && volume_of(piece.mesh) < largest; }));
}

std::vector<TriangleMesh> closed_pieces(const TriangleMesh& whole, Tally& tally, const TimeLimit& limit) {
  std::vector<ClosedPiece> closed;
  for (TriangleMesh& piece : pieces_of(whole)) {
    limit.check();
    closed.push_back(closed_piece(std::move(piece), tally, limit));
    if (closed.back().mesh.face_count() == 0) closed.pop_back();
  }
  tally.sheets = drop_sheets(closed);
  std::vector<TriangleMesh> pieces;
  for (ClosedPiece& piece : closed) pieces.push_back(std::move(piece.mesh));
  return pieces;
}

/// Returns how many.
Index drop_tiny(std::vector<TriangleMesh>& pieces) {
  Real sum = 0;
  for (const TriangleMesh& piece : pieces) sum += volume_of(piece);
  return static_cast<Index>(
      std::erase_if(pieces, [&](const TriangleMesh& piece) { return volume_of(piece) < least_volume * sum; }));
}

/// Self-intersections are cut out and filled, or else the piece is rebuilt.
TriangleMesh without_self_intersections(TriangleMesh piece, Tally& tally, const TimeLimit& limit) {
  if (!cuts_itself(piece, limit)) return piece;
  TriangleMesh mended = piece;
  if (cut_and_fill(mended, crumb_share, limit) && !is_flat(inspect_mesh(mended))) {
    ++tally.mended;
    return mended;
  }
  ++tally.rebuilt;
  return repair_mesh(rebuilt_as_solid(piece, limit), crumb_share).mesh;
}

void tell(const Tally& tally, FixedSurface& fixed) {
  const auto add = [&](Index count, const std::string& before, const char* thing, const char* things,
                       const std::string& after = "") {
    if (count > 0) fixed.repairs.push_back(before + counted(count, thing, things) + after);
  };
  add(tally.filled, "filled ", "hole", "holes");
  add(tally.flat, "dropped ", "piece", "pieces", " that could not be closed or enclose nothing");
  add(tally.sheets, "dropped ", "open sheet", "open sheets", ", whose closing would have made up what it encloses");
  add(tally.tiny, "dropped ", "tiny piece", "tiny pieces");
  add(tally.mended, "cut out where ", "piece cuts itself and filled", "pieces cut themselves and filled", " the holes");
  add(tally.rebuilt, "rebuilt ", "piece", "pieces", " from what it encloses, on a grid");
  add(tally.nested, "dropped ", "shell that lies in another", "shells that lie in another");
}

[[noreturn]] void refuse(const std::string& name) {
  throw InputError({name, "", "encloses no volume: it is flat, or its holes cannot be closed",
                    "export a closed surface, or rebuild it in a mesh editor"});
}

void check_input(const TriangleMesh& mesh, const std::string& name) {
  if (mesh.face_count() == 0) throw InputError({name, "", "holds no faces", "export a triangle surface"});
  if (!inspect_mesh(mesh).is_finite())
    throw InputError({name, "", "has coordinates that are not finite or faces that name vertices it does not have",
                      "export the surface again"});
}

/// Everything at once, where its pieces cannot be mended.
void rebuild(FixedSurface& fixed, const std::string& name, const TimeLimit& limit) {
  if (fixed.mesh.face_count() == 0) refuse(name);
  fixed.mesh = repair_mesh(rebuilt_as_solid(fixed.mesh, limit), crumb_share).mesh;
  const MeshReport report = inspect_mesh(fixed.mesh);
  if (!is_solid(report) || is_flat(report)) refuse(name);
  fixed.repairs.push_back("rebuilt the surface from what it encloses, on a grid");
}

/// Where much was dropped that could not be closed: all of it together may enclose more than what is left.
void rebuild_if_more(const TriangleMesh& whole, FixedSurface& fixed, const TimeLimit& limit) {
  const TriangleMesh rebuilt = repair_mesh(rebuilt_as_solid(whole, limit), crumb_share).mesh;
  if (rebuilt.face_count() == 0 || inspect_mesh(rebuilt).volume < inspect_mesh(fixed.mesh).volume) return;
  fixed.mesh = rebuilt;
  fixed.repairs.push_back("rebuilt the surface from what it encloses, on a grid");
}

}  // namespace

FixedSurface fix_surface(const TriangleMesh& mesh, const std::string& name, const TimeLimit& limit) {
  check_input(mesh, name);
  FixedSurface fixed;
  take(without_crumbs(mesh), fixed);
  if (!is_solid(inspect_mesh(fixed.mesh))) {
    fixed = {};
    take(repair_mesh(mesh), fixed);
    make_manifold(fixed);
    take(without_crumbs(fixed.mesh), fixed);
  }
  Tally tally;
  const TriangleMesh whole = fixed.mesh;
  const Real area = surface_area(whole.vertices, whole.faces);
  std::vector<TriangleMesh> pieces = closed_pieces(whole, tally, limit);
  tally.tiny = drop_tiny(pieces);
  if (pieces.empty()) {
    rebuild(fixed, name, limit);
    return fixed;
  }
  for (TriangleMesh& piece : pieces) piece = without_self_intersections(std::move(piece), tally, limit);
  std::erase_if(pieces, [](const TriangleMesh& piece) { return piece.face_count() == 0; });
  if (pieces.empty()) refuse(name);
  tally.nested = drop_nested(pieces);
  const std::size_t count = pieces.size();
  std::vector<TriangleMesh> heads = may_be_heads(pieces) ? pieces : std::vector<TriangleMesh>();
  United all = united(std::move(pieces), limit);
  // A union may enclose bubbles.
  all.pieces = pieces_of(merged(all.pieces));
  drop_tiny(all.pieces);
  tell(tally, fixed);
  if (all.united > 0) {
    fixed.heads = std::move(heads);
    fixed.repairs.push_back("united " + counted(static_cast<Index>(count), "piece", "pieces") + " that cut each other" +
                            (all.exact ? "" : ", on a grid"));
  }
  fixed.mesh = merged(all.pieces);
  if (all.pieces.size() > 1) take(repair_mesh(fixed.mesh, crumb_share), fixed);
  if (tally.flat > 0 && surface_area(fixed.mesh.vertices, fixed.mesh.faces) < least_area * area)
    rebuild_if_more(whole, fixed, limit);
  const MeshReport report = inspect_mesh(fixed.mesh);
  if (!is_solid(report) || !(report.volume > flattest * std::pow(area, 1.5))) refuse(name);
  return fixed;
}

}  // namespace gracilis
