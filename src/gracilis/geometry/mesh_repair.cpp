#include <gracilis/geometry/mesh_repair.hpp>

#include <gracilis/geometry/half_edges.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/winding_number.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace gracilis {

static std::string counted(const std::string& verb, Index count, const std::string& thing, const std::string& things,
                           Index first) {
  return verb + " " + std::to_string(count) + " " + (count == 1 ? thing : things) + ", first " + std::to_string(first);
}

/// Keeps the faces for which `keep` holds, in order.
template <typename Keep>
static void keep_faces(TriangleMesh& mesh, const Keep& keep) {
  Index kept = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (!keep(f)) continue;
    mesh.faces.col(kept++) = Eigen::Vector3i(mesh.faces.col(f));
  }
  mesh.faces.conservativeResize(3, kept);
}

static bool names_a_vertex_twice(const Eigen::Vector3i& f) { return f[0] == f[1] || f[1] == f[2] || f[2] == f[0]; }

static void drop_collapsed_faces(RepairedMesh& result) {
  MeshDefect collapsed;
  for (Index f = 0; f < result.mesh.face_count(); ++f) {
    if (names_a_vertex_twice(result.mesh.faces.col(f))) collapsed.add(f);
  }
  if (!collapsed) return;
  const Eigen::Matrix3Xi faces = result.mesh.faces;
  keep_faces(result.mesh, [&](Index f) { return !names_a_vertex_twice(faces.col(f)); });
  result.repairs.push_back(counted("dropped", collapsed.count, "face that names a vertex twice",
                                   "faces that name a vertex twice", collapsed.first));
}

/// Merging is right where it closes what was open or removes faces without area, and wrong where it makes new trouble:
/// the outcome decides.
static void merge_duplicates(RepairedMesh& result) {
  const MeshReport before = inspect_mesh(result.mesh);
  if (!before.duplicate_vertices) return;
  const std::vector<Index> first = first_at_same_place(result.mesh.vertices);
  TriangleMesh merged = result.mesh;
  for (Index& v : merged.faces.reshaped()) v = first[static_cast<std::size_t>(v)];
  const Eigen::Matrix3Xi faces = merged.faces;
  keep_faces(merged, [&](Index f) { return !names_a_vertex_twice(faces.col(f)); });
  const MeshReport after = inspect_mesh(merged);
  const bool helps =
      after.open_edges.count < before.open_edges.count || after.degenerate_faces.count < before.degenerate_faces.count;
  const bool harms = after.non_manifold_edges.count > before.non_manifold_edges.count ||
                     after.pinched_vertices.count > before.pinched_vertices.count ||
                     after.open_edges.count > before.open_edges.count;
  if (!helps || harms) return;
  result.mesh = std::move(merged);
  result.repairs.push_back(counted("merged", before.duplicate_vertices.count, "duplicate vertex", "duplicate vertices",
                                   before.duplicate_vertices.first));
}

/// The face on the other side of the directed edge a→b, which runs through it as b→a.
static std::optional<Index> opposite_face(const Eigen::Matrix3Xi& faces, Index a, Index b) {
  for (Index f = 0; f < static_cast<Index>(faces.cols()); ++f) {
    for (Index k = 0; k < 3; ++k) {
      if (faces(k, f) == b && faces((k + 1) % 3, f) == a) return f;
    }
  }
  return std::nullopt;
}

/// Replaces the line-like face (a, b, c) with longest edge ab, and its neighbor (b, a, d), by (a, d, c) and (d, b, c).
static bool flip_longest_edge(TriangleMesh& mesh, Index face) {
  Index longest = 0;
  const auto length = [&](Index k) {
    return (mesh.vertices.col(mesh.faces(k, face)) - mesh.vertices.col(mesh.faces((k + 1) % 3, face))).norm();
  };
  for (Index k = 1; k < 3; ++k) {
    if (length(k) > length(longest)) longest = k;
  }
  const Index a = mesh.faces(longest, face);
  const Index b = mesh.faces((longest + 1) % 3, face);
  const Index c = mesh.faces((longest + 2) % 3, face);
  const std::optional<Index> neighbor = opposite_face(mesh.faces, a, b);
  if (!neighbor) return false;
  const Index d = mesh.faces.col(*neighbor).sum() - a - b;
  if (d == c || opposite_face(mesh.faces, c, d) || opposite_face(mesh.faces, d, c)) return false;
  TriangleMesh flipped = mesh;
  flipped.faces.col(face) << a, d, c;
  flipped.faces.col(*neighbor) << d, b, c;
  if (is_degenerate(flipped, face) || is_degenerate(flipped, *neighbor)) return false;
  mesh = std::move(flipped);
  return true;
}

static void flip_lines(RepairedMesh& result) {
  MeshDefect flipped;
  for (Index f = 0; f < result.mesh.face_count(); ++f) {
    if (is_degenerate(result.mesh, f) && flip_longest_edge(result.mesh, f)) flipped.add(f);
  }
  if (flipped) {
    result.repairs.push_back(counted("flipped the longest edge of", flipped.count, "face without area",
                                     "faces without area", flipped.first));
  }
}

static void drop_crumbs(RepairedMesh& result, Real crumb_share) {
  const std::vector<Index> component = component_of_vertices(result.mesh);
  const Index count = component_count(component);
  if (count < 2 || crumb_share <= 0) return;
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(count);
  const auto component_of = [&, faces = result.mesh.faces](Index f) {
    return component[static_cast<std::size_t>(faces(0, f))];
  };
  for (Index f = 0; f < result.mesh.face_count(); ++f) {
    areas[component_of(f)] += area_vector(result.mesh.vertices, result.mesh.faces.col(f)).norm() / 2;
  }
  const Real limit = crumb_share * areas.sum();
  const auto crumbs = (areas.array() < limit).count();
  if (crumbs == 0) return;
  keep_faces(result.mesh, [&](Index f) { return areas[component_of(f)] >= limit; });
  result.repairs.push_back("dropped " + std::to_string(crumbs) + (crumbs == 1 ? " small piece" : " small pieces") +
                           " apart from the rest");
}

static void drop_unreferenced(RepairedMesh& result) {
  const std::vector<Index> component = component_of_vertices(result.mesh);
  MeshDefect unreferenced;
  std::vector<Index> renumbered(component.size(), -1);
  Index kept = 0;
  for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
    if (component[static_cast<std::size_t>(v)] < 0) {
      unreferenced.add(v);
      continue;
    }
    result.mesh.vertices.col(kept) = Vec3(result.mesh.vertices.col(v));
    renumbered[static_cast<std::size_t>(v)] = kept++;
  }
  if (!unreferenced) return;
  result.mesh.vertices.conservativeResize(3, kept);
  for (Index& v : result.mesh.faces.reshaped()) v = renumbered[static_cast<std::size_t>(v)];
  result.repairs.push_back(
      counted("dropped", unreferenced.count, "unreferenced vertex", "unreferenced vertices", unreferenced.first));
}

/// Neighbors of every face across edges with exactly two faces, and whether the two disagree in direction.
static std::vector<std::vector<std::pair<Index, bool>>> face_neighbors(const Eigen::Matrix3Xi& faces) {
  std::vector<std::vector<std::pair<Index, bool>>> neighbors(static_cast<std::size_t>(faces.cols()));
  const std::vector<HalfEdge> half_edges = sorted_half_edges(faces);
  for_each_edge(half_edges, [&](std::span<const HalfEdge> sides) {
    if (sides.size() != 2 || sides[0].face == sides[1].face) return;
    const bool disagree = sides[0].forward == sides[1].forward;
    neighbors[static_cast<std::size_t>(sides[0].face)].emplace_back(sides[1].face, disagree);
    neighbors[static_cast<std::size_t>(sides[1].face)].emplace_back(sides[0].face, disagree);
  });
  return neighbors;
}

/// Makes the faces that hang together with `seed` agree, turning the smaller part. Marks them as seen.
static Index make_patch_agree(Index seed, const std::vector<std::vector<std::pair<Index, bool>>>& neighbors,
                              std::vector<bool>& seen, Eigen::Matrix3Xi& faces) {
  std::vector<Index> patch = {seed};
  std::vector<bool> turned = {false};
  seen[static_cast<std::size_t>(seed)] = true;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    for (const auto& [neighbor, disagree] : neighbors[static_cast<std::size_t>(patch[i])]) {
      if (seen[static_cast<std::size_t>(neighbor)]) continue;
      seen[static_cast<std::size_t>(neighbor)] = true;
      patch.push_back(neighbor);
      turned.push_back(turned[i] != disagree);
    }
  }
  const auto turned_count = std::count(turned.begin(), turned.end(), true);
  const bool turn_marked = 2 * turned_count <= static_cast<long>(patch.size());
  Index changed = 0;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    if (turned[i] != turn_marked) continue;
    std::swap(faces(1, patch[i]), faces(2, patch[i]));
    ++changed;
  }
  return changed;
}

/// What hangs together of a closed surface.
struct ClosedPiece {
  std::vector<Index> faces;
  Real volume = 0;  ///< m³, negative where it is inside out
  Eigen::AlignedBox3d box;
};

static std::vector<ClosedPiece> closed_pieces(const TriangleMesh& mesh) {
  const std::vector<Index> component = component_of_vertices(mesh);
  std::vector<ClosedPiece> pieces(static_cast<std::size_t>(component_count(component)));
  for (Index f = 0; f < mesh.face_count(); ++f) {
    ClosedPiece& piece = pieces[static_cast<std::size_t>(component[static_cast<std::size_t>(mesh.faces(0, f))])];
    piece.faces.push_back(f);
    for (const Index v : mesh.faces.col(f)) piece.box.extend(mesh.vertices.col(v));
  }
  for (ClosedPiece& piece : pieces) piece.volume = enclosed_volume(mesh.vertices, mesh.faces(Eigen::all, piece.faces));
  return pieces;
}

/// By the middles of its faces: corners may touch what is around.
static bool lies_within(const ClosedPiece& piece, const TriangleMesh& mesh, const WindingNumber& around) {
  return std::all_of(piece.faces.begin(), piece.faces.end(), [&](Index f) {
    const Vec3 middle = mesh.vertices(Eigen::all, mesh.faces.col(f)).rowwise().mean();
    return std::abs(around.query(middle)) > 0.5;
  });
}

/// For every piece the largest one that it lies in; itself where there is none.
static std::vector<std::size_t> outermost_pieces(const TriangleMesh& mesh, const std::vector<ClosedPiece>& pieces) {
  std::vector<std::size_t> outermost(pieces.size());
  std::iota(outermost.begin(), outermost.end(), std::size_t{0});
  const auto size = [&](std::size_t p) { return std::abs(pieces[p].volume); };
  for (std::size_t outer = 0; outer < pieces.size(); ++outer) {
    std::optional<WindingNumber> around;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      if (size(outer) <= size(outermost[p]) || !pieces[outer].box.contains(pieces[p].box)) continue;
      if (!around) around.emplace(TriangleMesh{mesh.vertices, mesh.faces(Eigen::all, pieces[outer].faces)});
      if (lies_within(pieces[p], mesh, *around)) outermost[p] = outer;
    }
  }
  return outermost;
}

/// Each piece by its own volume, for that of all hides one that is inside out. Shells within a piece turn with it: they
/// may be its hollows.
static void turn_outwards(RepairedMesh& result) {
  const std::vector<ClosedPiece> pieces = closed_pieces(result.mesh);
  Real sum = 0;
  for (const ClosedPiece& piece : pieces) sum += std::abs(piece.volume);
  // Of a flat piece, which encloses nothing, rounding decides the sign.
  const auto is_inside_out = [&](const ClosedPiece& piece) { return piece.volume < -1e-12 * sum; };
  if (std::none_of(pieces.begin(), pieces.end(), is_inside_out)) return;
  const std::vector<std::size_t> outermost = outermost_pieces(result.mesh, pieces);
  std::size_t turned = 0;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    if (!is_inside_out(pieces[outermost[p]])) continue;
    for (const Index f : pieces[p].faces) std::swap(result.mesh.faces(1, f), result.mesh.faces(2, f));
    ++turned;
  }
  if (turned == pieces.size())
    result.repairs.push_back("turned all faces outwards");
  else if (turned > 0)
    result.repairs.push_back("turned " + std::to_string(turned) +
                             (turned == 1 ? " piece that was inside out" : " pieces that were inside out"));
}

static void orient(RepairedMesh& result) {
  Eigen::Matrix3Xi& faces = result.mesh.faces;
  if (inspect_mesh(result.mesh).inconsistent_edges) {
    const auto neighbors = face_neighbors(faces);
    std::vector<bool> seen(static_cast<std::size_t>(faces.cols()), false);
    Index changed = 0;
    for (Index f = 0; f < result.mesh.face_count(); ++f) {
      if (!seen[static_cast<std::size_t>(f)]) changed += make_patch_agree(f, neighbors, seen, faces);
    }
    if (changed > 0) {
      result.repairs.push_back("turned " + std::to_string(changed) + (changed == 1 ? " face" : " faces") +
                               " that disagreed with the faces around");
    }
  }
  const MeshReport report = inspect_mesh(result.mesh);
  if (report.is_closed() && report.is_oriented()) turn_outwards(result);
}

static bool is_sound(const MeshReport& report) {
  return report.is_closed() && report.is_manifold() && report.is_oriented() && report.volume > 0 &&
         report.components == 1 && !report.degenerate_faces && !report.unreferenced_vertices;
}

RepairedMesh repair_mesh(const TriangleMesh& mesh, Real crumb_share) {
  RepairedMesh result{mesh, {}};
  if (is_sound(inspect_mesh(mesh))) return result;
  drop_collapsed_faces(result);
  merge_duplicates(result);
  orient(result);  // before flipping edges, which looks for neighbors that agree
  flip_lines(result);
  drop_crumbs(result, crumb_share);
  drop_unreferenced(result);
  orient(result);
  return result;
}

}  // namespace gracilis
