#include <gracilis/prepare/reshaping.hpp>

#include <gracilis/geometry/mesh_repair.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/pieces.hpp>
#include <gracilis/prepare/rebuilding.hpp>
#include <gracilis/prepare/smoothing.hpp>
#include <gracilis/prepare/solids.hpp>
#include <gracilis/prepare/thickness.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace gracilis {
namespace {

constexpr Real largest_rounding_share = 0.4;  ///< of an edge
constexpr Real thinnest_radius = 0.45;        ///< of an edge: about three go around
constexpr Real finer = 0.6;                   ///< edges of the next attempt
constexpr int attempts = 3;

Real volume_error(const TriangleMesh& mesh, Real volume) { return std::abs(volume_of(mesh) / volume - 1); }

/// A solid in, a solid of about the same volume out, or nothing.
std::optional<TriangleMesh> remeshed_solid(const TriangleMesh& mesh, Real edge_length, int rounds,
                                           const TimeLimit& limit) {
  limit.check();
  std::optional<TriangleMesh> result = remesh_isotropic(mesh, edge_length, rounds, limit);
  if (result) *result = repair_mesh(*result).mesh;  // needles may have become lines
  if (!result || !is_solid(*result) || volume_error(*result, volume_of(mesh)) > 0.5) return std::nullopt;
  return result;
}

std::optional<TriangleMesh> shaped_piece(const TriangleMesh& piece, Real edge_length, const PrepareSettings& settings,
                                         const TimeLimit& limit) {
  std::optional<TriangleMesh> fine = remeshed_solid(piece, edge_length / 2, 3, limit);
  if (!fine) return std::nullopt;
  if (settings.rounding_rounds > 0) {
    thicken(*fine, thinnest_radius * edge_length, limit);
    round_off(*fine, sharpest_turn, settings.rounding_rounds, largest_rounding_share * edge_length);
  }
  std::optional<TriangleMesh> shaped = remeshed_solid(*fine, edge_length, settings.remeshing_rounds, limit);
  if (!shaped) return std::nullopt;
  round_off(*shaped, sharpest_turn, settings.rounding_rounds, largest_rounding_share * edge_length);
  const Real volume = volume_of(piece);
  if (volume_error(*shaped, volume) > settings.volume_tolerance) set_volume(*shaped, volume, limit);
  return is_solid(*shaped) ? shaped : std::nullopt;
}

/// Smaller triangles where the volume asks for it, or where the piece is too small for others.
std::optional<TriangleMesh> best_shape(const TriangleMesh& piece, const PrepareSettings& settings,
                                       const TimeLimit& limit) {
  std::optional<TriangleMesh> best;
  Real edge_length = settings.edge_length;
  const Real volume = volume_of(piece);
  Real left = limit.left();
  for (int attempt = 0; attempt < attempts; ++attempt, edge_length *= finer) {
    // The next would take some four times as long as the last.
    const Real spent = left - limit.left();
    left -= spent;
    if (best && 4 * spent > left) break;
    std::optional<TriangleMesh> shape = shaped_piece(piece, edge_length, settings, limit);
    if (!shape) break;
    if ((!best || volume_error(*shape, volume) < volume_error(*best, volume))) best = std::move(shape);
    if ((settings.volume_tolerance >= 1 || volume_error(*best, volume) <= settings.volume_tolerance)) break;
  }
  return best;
}

}  // namespace

bool has_edges_about(const TriangleMesh& mesh, Real length) {
  Real sum = 0, shortest = length, longest = length;
  const MeshTopology topology = build_topology(mesh.faces, mesh.vertex_count());
  for (const MeshEdge& edge : topology.edges) {
    const Real l = (mesh.vertices.col(edge.a) - mesh.vertices.col(edge.b)).norm();
    sum += l, shortest = std::min(shortest, l), longest = std::max(longest, l);
  }
  const Real mean = sum / static_cast<Real>(topology.edges.size());
  return std::abs(mean / length - 1) < 0.15 && shortest > 0.2 * length && longest < 2.2 * length;
}

TriangleMesh reshaped(const TriangleMesh& mesh, const PrepareSettings& settings, const TimeLimit& limit,
                      const std::function<void(const std::string&)>& say) {
  std::vector<TriangleMesh> pieces = pieces_of(mesh);
  for (TriangleMesh& piece : pieces) {
    std::optional<TriangleMesh> shape = best_shape(piece, settings, limit);
    // Triangles of a grid can be remeshed, whatever those were.
    if (!shape)
      if (const TriangleMesh solid = largest_piece(rebuilt_as_solid(piece, limit)); solid.face_count() > 0)
        shape = best_shape(solid, settings, limit);
    if (shape)
      piece = std::move(*shape);
    else
      say("a piece of " + std::to_string(piece.face_count()) + " triangles could not be remeshed and stays as it is");
  }
  return merged(pieces);
}

TriangleMesh remeshed(const TriangleMesh& mesh, const PrepareSettings& settings, const TimeLimit& limit) {
  std::vector<TriangleMesh> pieces = pieces_of(mesh);
  for (TriangleMesh& piece : pieces)
    if (std::optional<TriangleMesh> result =
            remeshed_solid(piece, settings.edge_length, settings.remeshing_rounds, limit))
      piece = std::move(*result);
  return merged(pieces);
}

}  // namespace gracilis
