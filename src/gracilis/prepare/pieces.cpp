#include <gracilis/prepare/pieces.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_repair.hpp>
#include <gracilis/geometry/principal_axes.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/rebuilding.hpp>
#include <gracilis/prepare/solids.hpp>

#include <algorithm>
#include <array>
#include <optional>

namespace gracilis {

/// What cuts each other more often costs exact arithmetic minutes, and is no clean overlap.
static constexpr std::ptrdiff_t most_exact_pairs = 5000;
static constexpr std::size_t most_exact_pieces = 8;

Index drop_nested(std::vector<TriangleMesh>& pieces) {
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const TriangleMesh& l, const TriangleMesh& r) { return volume_of(l) > volume_of(r); });
  std::vector<TriangleMesh> kept;
  std::vector<SignedDistance> around;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (TriangleMesh& piece : pieces) {
    const Eigen::AlignedBox3d box = bounding_box(piece.vertices);
    const Real tolerance = 1e-4 * box.diagonal().norm();
    bool nested = false;
    for (std::size_t k = 0; k < kept.size() && !nested; ++k)
      nested = boxes[k].intersects(box) && share_within(piece, around[k], tolerance, 300) >= 0.98;
    if (nested) continue;
    boxes.push_back(box);
    around.emplace_back(piece);
    kept.push_back(std::move(piece));
  }
  const auto dropped = static_cast<Index>(pieces.size() - kept.size());
  pieces = std::move(kept);
  return dropped;
}

namespace {

/// From where to where, along some line.
struct Extent {
  Real low, high;
  Real length() const { return high - low; }
};

Extent extent_along(const Vec3& direction, const TriangleMesh& mesh) {
  const Eigen::RowVectorXd along = direction.transpose() * mesh.vertices;
  return {along.minCoeff(), along.maxCoeff()};
}

}  // namespace

bool may_be_heads(const std::vector<TriangleMesh>& pieces) {
  constexpr Real least_volume = 0.1, least_length = 0.5, least_beside = 2.0 / 3, most_within = 0.3;
  if (pieces.size() < 2) return false;
  const TriangleMesh whole = merged(pieces);
  const Vec3 axis = spread_of(whole.vertices).most();
  const Extent all = extent_along(axis, whole), first = extent_along(axis, pieces.front());
  Real sum = 0;
  for (const TriangleMesh& piece : pieces) sum += volume_of(piece);
  const auto runs_beside = [&](const TriangleMesh& piece) {
    const Extent own = extent_along(axis, piece);
    const Real beside = std::min(own.high, first.high) - std::max(own.low, first.low);
    return volume_of(piece) >= least_volume * sum && own.length() >= least_length * all.length() &&
           beside >= least_beside * own.length();
  };
  if (!std::all_of(pieces.begin(), pieces.end(), runs_beside)) return false;
  for (std::size_t outer = 0; outer + 1 < pieces.size(); ++outer) {
    const SignedDistance around(pieces[outer]);
    for (std::size_t k = outer + 1; k < pieces.size(); ++k)
      if (share_within(pieces[k], around, 0, 300) > most_within) return false;
  }
  return true;
}

/// Pairs of triangles of the two that meet and have no corner in common: pieces that were joined in a vertex or an edge
/// touch there.
static std::ptrdiff_t crossing_pairs(const TriangleMesh& a, const TriangleMesh& b, const TimeLimit& limit) {
  if (!bounding_box(a.vertices).intersects(bounding_box(b.vertices))) return 0;
  const std::array<const TriangleMesh*, 2> both = {&a, &b};
  const auto touch = [&](const FacePair& pair) {
    for (const Index i : a.faces.col(pair.face_a))
      for (const Index j : b.faces.col(pair.face_b))
        if (a.vertices.col(i) == b.vertices.col(j)) return true;
    return false;
  };
  const std::vector<FacePair> pairs = intersecting_faces(both, true, limit);
  return std::count_if(pairs.begin(), pairs.end(), [&](const FacePair& pair) { return !touch(pair); });
}

/// None where exact arithmetic cannot, or would take minutes.
static std::optional<TriangleMesh> sound_union(const TriangleMesh& a, const TriangleMesh& b, const TimeLimit& limit) {
  const std::ptrdiff_t pairs = crossing_pairs(a, b, limit);
  if (pairs == 0) return merged({a, b});
  if (pairs > most_exact_pairs) return std::nullopt;
  const std::optional<TriangleMesh> both = exact_union(a, b, limit);
  if (!both) return std::nullopt;
  TriangleMesh mended = repair_mesh(*both).mesh;
  const MeshReport report = inspect_mesh(mended);
  const bool sound = is_solid(report) && report.volume > 0.99 * std::max(volume_of(a), volume_of(b));
  if (!sound || cuts_itself(mended, limit)) return std::nullopt;
  return mended;
}

/// Of pieces that hang together by their overlaps.
static TriangleMesh union_of(const std::vector<TriangleMesh>& pieces, const TimeLimit& limit, bool& exact) {
  TriangleMesh whole = pieces.front();
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    limit.check();
    std::optional<TriangleMesh> both =
        pieces.size() <= most_exact_pieces ? sound_union(whole, pieces[k], limit) : std::nullopt;
    if (!both) {
      exact = false;
      return rebuilt_as_solid(merged(pieces), limit);
    }
    whole = std::move(*both);
  }
  return whole;
}

/// For every piece the number of its group: those that cut each other, directly or by others between them.
static std::vector<std::size_t> groups_of(const std::vector<TriangleMesh>& pieces, const TimeLimit& limit) {
  std::vector<std::size_t> group(pieces.size());
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    limit.check();
    group[k] = k;
    for (std::size_t i = 0; i < k; ++i) {
      if (group[i] == group[k] || crossing_pairs(pieces[i], pieces[k], limit) == 0) continue;
      const std::size_t from = std::max(group[i], group[k]), to = std::min(group[i], group[k]);
      for (std::size_t& g : group)
        if (g == from) g = to;
    }
  }
  return group;
}

United united(std::vector<TriangleMesh> pieces, const TimeLimit& limit) {
  United result;
  const std::vector<std::size_t> group = groups_of(pieces, limit);
  for (std::size_t g = 0; g < pieces.size(); ++g) {
    std::vector<TriangleMesh> members;
    for (std::size_t k = g; k < pieces.size(); ++k)
      if (group[k] == g) members.push_back(std::move(pieces[k]));
    if (members.empty()) continue;
    result.united += static_cast<Index>(members.size()) - 1;
    result.pieces.push_back(members.size() == 1 ? std::move(members.front()) : union_of(members, limit, result.exact));
  }
  return result;
}

}  // namespace gracilis
