#include <gracilis/prepare/reshaping.hpp>

#include <gracilis/geometry/decimation.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_repair.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/comparisons.hpp>
#include <gracilis/prepare/cut_and_fill.hpp>
#include <gracilis/prepare/following.hpp>
#include <gracilis/prepare/pieces.hpp>
#include <gracilis/prepare/rebuilding.hpp>
#include <gracilis/prepare/smoothing.hpp>
#include <gracilis/prepare/solids.hpp>
#include <gracilis/prepare/thickness.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace gracilis {
namespace {

constexpr Real largest_rounding_share = 0.4;  ///< of an edge
constexpr Real thinnest_radius = 0.45;        ///< of an edge: about three go around
constexpr Real fewest_triangles = 400;        ///< of a piece
constexpr Real most_lost = 3;                 ///< edges: a tip, and no tendon

/// A solid in, a solid of about the same volume out, or nothing.
std::optional<TriangleMesh> remeshed_solid(const TriangleMesh& mesh, Real edge_length, int rounds,
                                           const TimeLimit& limit) {
  limit.check();
  std::optional<TriangleMesh> result = remesh_isotropic(mesh, edge_length, rounds, limit);
  if (result) *result = repair_mesh(*result).mesh;  // needles may have become lines
  if (!result || !is_solid(*result) || volume_error(*result, volume_of(mesh)) > 0.5) return std::nullopt;
  return result;
}

/// What may become of a piece: triangles of a size, thickened and rounded or as thin as it is.
struct Attempt {
  Real share;  ///< of the edge length
  bool rounded;
};
constexpr std::array<Attempt, 4> attempts = {{{1, true}, {0.6, true}, {1, false}, {0.36, true}}};

/// The piece in triangles of that size.
std::optional<TriangleMesh> in_triangles(const TriangleMesh& piece, Real edge_length, bool rounded,
                                         const PrepareSettings& settings, const TimeLimit& limit) {
  if (!rounded) return remeshed_solid(piece, edge_length, settings.remeshing_rounds, limit);
  std::optional<TriangleMesh> fine = remeshed_solid(piece, edge_length / 2, 3, limit);
  if (!fine) return std::nullopt;
  const Real radius = thicken(*fine, thinnest_radius * edge_length, limit);
  const Real farthest = std::min(largest_rounding_share * edge_length, radius);
  round_off(*fine, sharpest_turn, settings.rounding_rounds, farthest);
  std::optional<TriangleMesh> shape = remeshed_solid(*fine, edge_length, settings.remeshing_rounds, limit);
  if (shape) round_off(*shape, sharpest_turn, settings.rounding_rounds, farthest);
  return shape;
}

/// Where the shape cuts itself that is cut out, or else it follows the piece there. Tells whether it is sound then.
bool mend(TriangleMesh& shape, const TriangleMesh& piece, const TimeLimit& limit) {
  if (!is_solid(shape)) return false;
  TriangleMesh cut = shape;
  if (cut_and_fill(cut, 0, limit) && pieces_of(cut).size() == 1) {
    shape = std::move(cut);
    return true;
  }
  return follow_where_cut(shape, piece, limit);
}

/// The same with its volume and without self-intersections; none where that fails or part of the piece got lost.
std::optional<TriangleMesh> shaped_piece(const TriangleMesh& piece, Real edge_length, bool rounded,
                                         const PrepareSettings& settings, const TimeLimit& limit) {
  std::optional<TriangleMesh> shape = in_triangles(piece, edge_length, rounded, settings, limit);
  if (!shape) return std::nullopt;
  const Real volume = volume_of(piece);
  if (!mend(*shape, piece, limit)) return std::nullopt;
  if (volume_error(*shape, volume) > settings.volume_tolerance) {
    set_volume(*shape, volume, limit);
    if (!mend(*shape, piece, limit)) return std::nullopt;
  }
  if (distance_from_to(piece, *shape).largest > most_lost * edge_length) return std::nullopt;
  return shape;
}

/// Of a small piece less than asked for, so that there are triangles enough for a shape.
Real longest_edge_for(const TriangleMesh& piece, Real edge_length) {
  const Real area = surface_area(piece.vertices, piece.faces);
  return std::min(edge_length, std::sqrt(area / (fewest_triangles * std::sqrt(3.0) / 4)));
}

/// For a part of the work, so that something is left for what goes without it.
TimeLimit most_of(const TimeLimit& limit) {
  constexpr Real share = 0.6;
  const Real left = limit.left();
  return std::isfinite(left) ? TimeLimit(std::max(share * left, 1e-3)) : TimeLimit();
}

/// Other attempts where the volume asks for it, or where the shape cuts itself.
std::optional<TriangleMesh> best_shape(const TriangleMesh& piece, const PrepareSettings& settings,
                                       const TimeLimit& limit) {
  std::optional<TriangleMesh> best;
  const Real edge_length = longest_edge_for(piece, settings.edge_length);
  const Real volume = volume_of(piece);
  const TimeLimit own = most_of(limit);
  Real left = own.left();
  for (const Attempt& attempt : attempts) try {
      const bool rounded = attempt.rounded && settings.rounding_rounds > 0;
      std::optional<TriangleMesh> shape = shaped_piece(piece, attempt.share * edge_length, rounded, settings, own);
      if (shape && (!best || volume_error(*shape, volume) < volume_error(*best, volume))) best = std::move(shape);
      if (best && (settings.volume_tolerance >= 1 || volume_error(*best, volume) <= settings.volume_tolerance)) break;
      // The next would take some four times as long as the last.
      const Real spent = left - own.left();
      left -= spent;
      if (4 * spent > left) break;
    } catch (const OutOfTime&) {
      break;
    }
  return best;
}

/// Triangles of a grid can be remeshed, whatever those of the piece were.
std::optional<TriangleMesh> best_rebuilt(const TriangleMesh& piece, const PrepareSettings& settings,
                                         const TimeLimit& limit) try {
  const TimeLimit own = most_of(limit);
  const TriangleMesh solid = largest_piece(rebuilt_as_solid(piece, own));
  if (solid.face_count() == 0 || distance_from_to(piece, solid).largest > most_lost * settings.edge_length)
    return std::nullopt;
  return best_shape(solid, settings, own);
} catch (const OutOfTime&) {
  return std::nullopt;
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

TriangleMesh coarsened(const TriangleMesh& mesh, Real edge_length, const TimeLimit& limit) {
  const Real area = surface_area(mesh.vertices, mesh.faces);
  for (Real count = area / (std::sqrt(3.0) / 2 * edge_length * edge_length); count < mesh.vertex_count(); count *= 2) {
    limit.check();
    const CoarseSurface coarse = decimate(mesh, static_cast<Index>(count));
    TriangleMesh result{picked(mesh.vertices, coarse.vertices), coarse.faces};
    if (is_solid(result) && !cuts_itself(result, limit)) return result;
  }
  return mesh;
}

TriangleMesh reshaped(const TriangleMesh& mesh, const PrepareSettings& settings, const TimeLimit& limit,
                      const std::function<void(const std::string&)>& say) {
  std::vector<TriangleMesh> pieces = pieces_of(mesh);
  for (TriangleMesh& piece : pieces) {
    std::optional<TriangleMesh> shape = best_shape(piece, settings, limit);
    if (!shape) shape = best_rebuilt(piece, settings, limit);
    if (shape) {
      piece = std::move(*shape);
      continue;
    }
    const Index before = piece.face_count();
    const Real volume = volume_of(piece);
    piece = coarsened(piece, longest_edge_for(piece, settings.edge_length), limit);
    give_volume_back(piece, volume, settings.volume_tolerance, limit);
    say("a piece of " + std::to_string(before) + " triangles could not be remeshed and " +
        (piece.face_count() < before ? "was thinned to " + std::to_string(piece.face_count()) : "stays as it is"));
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
