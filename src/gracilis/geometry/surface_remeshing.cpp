#include <gracilis/geometry/surface_remeshing.hpp>

#include <gracilis/core/sort_unique.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace gracilis {

namespace {

using Face = std::array<Index, 3>;

/// A closed manifold mesh being edited. Removed faces have corner 0 = -1 until compact().
class EditableMesh {
 public:
  explicit EditableMesh(const TriangleMesh& mesh) {
    for (Index v = 0; v < mesh.vertex_count(); ++v) points_.push_back(mesh.vertices.col(v));
    for (Index f = 0; f < mesh.face_count(); ++f)
      faces_.push_back({mesh.faces(0, f), mesh.faces(1, f), mesh.faces(2, f)});
    list_stars();
  }

  TriangleMesh mesh() const {
    TriangleMesh result;
    result.vertices.resize(3, static_cast<Index>(points_.size()));
    std::vector<Index> renumbered(points_.size(), -1);
    Index count = 0;
    for (std::size_t v = 0; v < points_.size(); ++v)
      if (!stars_[v].empty()) {
        renumbered[v] = count;
        result.vertices.col(count++) = points_[v];
      }
    result.vertices.conservativeResize(3, count);
    result.faces.resize(3, static_cast<Index>(faces_.size()));
    count = 0;
    for (const Face& face : faces_)
      if (face[0] >= 0) result.faces.col(count++) << renumbered[face[0]], renumbered[face[1]], renumbered[face[2]];
    result.faces.conservativeResize(3, count);
    return result;
  }

  void split_long_edges(Real longest);
  void collapse_short_edges(Real shortest, Real longest);
  void flip_edges();
  void smooth();

 private:
  /// The two faces beside an edge and the vertices opposite to it; faces[0] runs from a to b.
  struct Dihedral {
    std::array<Index, 2> faces{-1, -1};
    std::array<Index, 2> opposite{-1, -1};
  };

  void list_stars() {
    stars_.assign(points_.size(), {});
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (Index v : faces_[f]) stars_[v].push_back(static_cast<Index>(f));
  }

  Dihedral dihedral(Index a, Index b) const {
    Dihedral result;
    for (Index f : stars_[a])
      for (int c = 0; c < 3; ++c) {
        const Index from = faces_[f][c], to = faces_[f][(c + 1) % 3];
        const int side = from == a && to == b ? 0 : from == b && to == a ? 1 : -1;
        if (side < 0) continue;
        result.faces[side] = f;
        result.opposite[side] = faces_[f][(c + 2) % 3];
      }
    return result;
  }

  bool adjacent(Index a, Index b) const {
    return std::any_of(stars_[a].begin(), stars_[a].end(),
                       [&](Index f) { return std::find(faces_[f].begin(), faces_[f].end(), b) != faces_[f].end(); });
  }

  Vec3 area_normal(const Face& face) const {
    return (points_[face[1]] - points_[face[0]]).cross(points_[face[2]] - points_[face[0]]) / 2;
  }

  Real length(Index a, Index b) const { return (points_[a] - points_[b]).norm(); }

  void drop_from_star(Index v, Index face) {
    auto& star = stars_[v];
    star.erase(std::find(star.begin(), star.end(), face));
  }

  void split(Index a, Index b);
  bool can_collapse(Index a, Index b, Real longest) const;
  void collapse(Index a, Index b);
  void flip_if_better(Index a, Index b);

  /// Calls work(a, b) for every edge a < b that exists when its turn comes, in the order of faces.
  template <typename Work>
  void for_each_edge(Work work) {
    const std::size_t count = faces_.size();
    for (std::size_t f = 0; f < count; ++f)
      for (int c = 0; c < 3; ++c) {
        const Face face = faces_[f];
        if (face[0] < 0) break;
        if (face[c] < face[(c + 1) % 3]) work(face[c], face[(c + 1) % 3]);
      }
  }

  std::vector<Vec3> points_;
  std::vector<Face> faces_;
  std::vector<std::vector<Index>> stars_;  // faces around each vertex
};

void EditableMesh::split(Index a, Index b) {
  const Dihedral at = dihedral(a, b);
  const Index middle = static_cast<Index>(points_.size());
  points_.emplace_back((points_[a] + points_[b]) / 2);
  stars_.emplace_back();
  for (int side = 0; side < 2; ++side) {
    const Index f = at.faces[side], added = static_cast<Index>(faces_.size());
    // The old face keeps a, the new one takes b.
    Face half = faces_[f];
    std::replace(half.begin(), half.end(), a, middle);
    std::replace(faces_[f].begin(), faces_[f].end(), b, middle);
    faces_.push_back(half);
    drop_from_star(b, f);
    stars_[b].push_back(added);
    stars_[at.opposite[side]].push_back(added);
    stars_[middle].push_back(f);
    stars_[middle].push_back(added);
  }
}

void EditableMesh::split_long_edges(Real longest) {
  for_each_edge([&](Index a, Index b) {
    if (length(a, b) > longest) split(a, b);
  });
}

bool EditableMesh::can_collapse(Index a, Index b, Real longest) const {
  // Link condition: exactly the two opposite vertices are neighbors of both, or the surface would pinch.
  std::vector<Index> around;
  for (Index f : stars_[a])
    for (Index v : faces_[f])
      if (v != a && v != b) around.push_back(v);
  sort_unique(around);
  if (std::count_if(around.begin(), around.end(), [&](Index v) { return adjacent(b, v); }) != 2) return false;
  const Dihedral at = dihedral(a, b);
  if (stars_[at.opposite[0]].size() < 4 || stars_[at.opposite[1]].size() < 4) return false;

  const Vec3 middle = (points_[a] + points_[b]) / 2;
  for (Index end : {a, b})
    for (Index f : stars_[end]) {
      if (f == at.faces[0] || f == at.faces[1]) continue;
      std::array<Vec3, 3> corners;
      for (int c = 0; c < 3; ++c) {
        const Index v = faces_[f][c];
        corners[c] = v == end ? middle : points_[v];
        if (v != end && (points_[v] - middle).norm() > longest) return false;
      }
      // No face may turn over or become a sliver.
      const Vec3 before = area_normal(faces_[f]);
      const Vec3 after = (corners[1] - corners[0]).cross(corners[2] - corners[0]) / 2;
      if (after.norm() < 1e-3 * longest * longest || after.dot(before) < 0.3 * after.norm() * before.norm()) {
        if (before.norm() > 1e-6 * longest * longest) return false;
      }
    }
  return true;
}

void EditableMesh::collapse(Index a, Index b) {
  const Dihedral at = dihedral(a, b);
  points_[a] = (points_[a] + points_[b]) / 2;
  for (int side = 0; side < 2; ++side) {
    const Index f = at.faces[side];
    for (Index v : {a, b, at.opposite[side]}) drop_from_star(v, f);
    faces_[f][0] = -1;
  }
  for (Index f : stars_[b]) {
    std::replace(faces_[f].begin(), faces_[f].end(), b, a);
    stars_[a].push_back(f);
  }
  stars_[b].clear();
}

void EditableMesh::collapse_short_edges(Real shortest, Real longest) {
  for_each_edge([&](Index a, Index b) {
    if (length(a, b) < shortest && can_collapse(a, b, longest)) collapse(a, b);
  });
}

void EditableMesh::flip_if_better(Index a, Index b) {
  const Dihedral at = dihedral(a, b);
  const Index c = at.opposite[0], d = at.opposite[1];
  if (c == d || adjacent(c, d)) return;
  const auto off = [&](Index v, int change) { return std::abs(static_cast<int>(stars_[v].size()) + change - 6); };
  const int before = off(a, 0) + off(b, 0) + off(c, 0) + off(d, 0);
  const int after = off(a, -1) + off(b, -1) + off(c, 1) + off(d, 1);
  if (after >= before || stars_[a].size() <= 3 || stars_[b].size() <= 3) return;
  // Only where the dihedral is about flat: the new faces must look the same way as the old ones.
  const Face first = {c, a, d}, second = {d, b, c};
  const Vec3 old = area_normal(faces_[at.faces[0]]) + area_normal(faces_[at.faces[1]]);
  for (const Face& face : {first, second}) {
    const Vec3 normal = area_normal(face);
    if (normal.dot(old) < 0.8 * normal.norm() * old.norm() || normal.norm() < 0.05 * old.norm()) return;
  }
  drop_from_star(a, at.faces[1]);
  drop_from_star(b, at.faces[0]);
  faces_[at.faces[0]] = first;
  faces_[at.faces[1]] = second;
  stars_[c].push_back(at.faces[1]);
  stars_[d].push_back(at.faces[0]);
}

void EditableMesh::flip_edges() {
  for_each_edge([&](Index a, Index b) { flip_if_better(a, b); });
}

/// Moves every vertex within its tangent plane towards the center of its faces, weighted by their areas.
void EditableMesh::smooth() {
  std::vector<Vec3> moved = points_;
  for (std::size_t v = 0; v < points_.size(); ++v) {
    Vec3 center = Vec3::Zero(), normal = Vec3::Zero();
    Real weight = 0;
    for (Index f : stars_[v]) {
      const Vec3 n = area_normal(faces_[f]);
      const Real area = n.norm();
      center += area / 3 * (points_[faces_[f][0]] + points_[faces_[f][1]] + points_[faces_[f][2]]);
      normal += n;
      weight += area;
    }
    if (weight <= 0 || normal.norm() <= 0) continue;
    normal.normalize();
    const Vec3 move = center / weight - points_[v];
    moved[v] += move - normal * normal.dot(move);
  }
  points_ = moved;
}

}  // namespace

TriangleMesh remesh(const TriangleMesh& mesh, const SampledSolid& solid, Real edge_length) {
  // The usual bounds: an edge longer than 4/3 halves into pieces nearer to the target, one shorter than 4/5 is better
  // gone.
  const Real longest = edge_length * 4 / 3, shortest = edge_length * 4 / 5;
  TriangleMesh result = mesh;
  constexpr int rounds = 8;
  for (int round = 0; round < rounds; ++round) {
    EditableMesh editable(result);
    editable.split_long_edges(longest);
    editable.collapse_short_edges(shortest, longest);
    editable.flip_edges();
    editable.smooth();
    result = editable.mesh();
    project_to_surface(result, solid);
  }
  return result;
}

}  // namespace gracilis
