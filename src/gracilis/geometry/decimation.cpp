#include <gracilis/geometry/decimation.hpp>

#include <gracilis/core/sort_unique.hpp>
#include <gracilis/geometry/topology.hpp>

#include <algorithm>
#include <numeric>
#include <queue>

namespace gracilis {

namespace {

/// How much an edge's squared length counts against the squared distance to a plane.
constexpr Real length_share = 1e-3;
/// A triangle may turn by at most 60 degrees in one collapse, and become no thinner than this (4 √3 area over the sum
/// of the squared sides, 1 for equilateral ones) unless it was thinner.
constexpr Real least_cosine = 0.5, least_shape = 0.2;
/// More triangles than this around one vertex would need as many colors.
constexpr std::size_t most_faces = 12;

/// Sum of area times squared distance to planes: x'Ax + 2 b'x + c.
struct Quadric {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Vec3 b = Vec3::Zero();
  Real c = 0, area = 0;

  Real at(const Vec3& x) const { return std::max(x.dot(a * x) + 2 * b.dot(x) + c, Real{0}); }
  Quadric& operator+=(const Quadric& other) {
    a += other.a, b += other.b, c += other.c, area += other.area;
    return *this;
  }
};

Quadric plane_quadric(const Vec3& point, const Vec3& area_normal) {
  Quadric q;
  const Real area = area_normal.norm();
  if (!(area > 0)) return q;
  const Vec3 n = area_normal / area;
  const Real d = -n.dot(point);
  q.a = area * n * n.transpose(), q.b = area * d * n, q.c = area * d * d, q.area = area;
  return q;
}

struct Collapse {
  Real cost;
  Index gone, kept;
  int version;  ///< of both ends together when the cost was computed
  bool operator<(const Collapse& other) const {
    return std::tie(cost, gone, kept) > std::tie(other.cost, other.gone, other.kept);  // the cheapest is the top
  }
};

class Decimation {
 public:
  Decimation(const TriangleMesh& mesh, std::span<const Index> labels)
      : x_(mesh.vertices),
        faces_(mesh.faces),
        labels_(labels),
        alive_(static_cast<std::size_t>(mesh.face_count()), 1),
        around_(static_cast<std::size_t>(mesh.vertex_count())),
        quadrics_(around_.size()),
        border_(around_.size(), 0),
        versions_(around_.size(), 0),
        went_to_(around_.size()) {
    std::iota(went_to_.begin(), went_to_.end(), 0);
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const Quadric q = plane_quadric(x_.col(faces_(0, f)), normal(faces_.col(f)) / 2);
      for (int k = 0; k < 3; ++k) {
        around_[at(faces_(k, f))].push_back(f);
        quadrics_[at(faces_(k, f))] += q;
      }
    }
    for (const MeshEdge& edge : build_topology(faces_, mesh.vertex_count()).edges) {
      if (edge.left < 0 || edge.right < 0) border_[at(edge.a)] = border_[at(edge.b)] = 1;
      edges_.push_back({edge.a, edge.b});
    }
  }

  CoarseSurface reduce_to(Index vertex_count) {
    for (const auto& [a, b] : edges_) offer(a, b);
    auto left = static_cast<Index>(
        std::count_if(around_.begin(), around_.end(), [](const auto& faces) { return !faces.empty(); }));
    while (left > vertex_count && !queue_.empty()) {
      const Collapse next = queue_.top();
      queue_.pop();
      if (next.version != version(next.gone, next.kept) || !may(next.gone, next.kept)) continue;
      collapse(next.gone, next.kept);
      --left;
    }
    return what_is_left();
  }

 private:
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }

  Vec3 normal(const Eigen::Vector3i& corners) const {
    const Vec3 a = x_.col(corners[0]);
    return (x_.col(corners[1]) - a).cross(x_.col(corners[2]) - a);
  }

  static Real shape(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Real sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    return sides > 0 ? 2 * std::sqrt(Real{3}) * (b - a).cross(c - a).norm() / sides : 0;
  }

  int version(Index a, Index b) const { return versions_[at(a)] + versions_[at(b)]; }

  /// Both ways to collapse an edge, into the queue.
  void offer(Index a, Index b) {
    if (!labels_.empty() && labels_[at(a)] != labels_[at(b)]) return;
    for (const auto& [gone, kept] : {std::pair(a, b), std::pair(b, a)}) {
      if (border_[at(gone)]) continue;
      Quadric both = quadrics_[at(a)];
      both += quadrics_[at(b)];
      const Real length = (x_.col(a) - x_.col(b)).squaredNorm();
      queue_.push({both.at(x_.col(kept)) + length_share * both.area * length, gone, kept, version(a, b)});
    }
  }

  std::vector<Index> neighbors(Index v) const {
    std::vector<Index> ring;
    for (const Index f : around_[at(v)])
      for (int k = 0; k < 3; ++k)
        if (faces_(k, f) != v) ring.push_back(faces_(k, f));
    sort_unique(ring);
    return ring;
  }

  bool touches(Index f, Index v) const { return faces_(0, f) == v || faces_(1, f) == v || faces_(2, f) == v; }

  /// The surface stays a surface of the same topology (link condition), and no triangle turns over or becomes a sliver.
  bool may(Index gone, Index kept) const {
    const std::vector<Index> of_gone = neighbors(gone), of_kept = neighbors(kept);
    std::vector<Index> common;
    std::set_intersection(of_gone.begin(), of_gone.end(), of_kept.begin(), of_kept.end(), std::back_inserter(common));
    std::size_t shared = 0;
    for (const Index f : around_[at(gone)]) shared += touches(f, kept);
    // Fewer than four triangles around a neighbor of both would leave two on top of each other.
    for (const Index v : common)
      if (around_[at(v)].size() < 4) return false;
    if (shared == 0 || common.size() != shared) return false;
    if (around_[at(gone)].size() + around_[at(kept)].size() - 2 * shared > most_faces) return false;
    for (const Index f : around_[at(gone)]) {
      if (touches(f, kept)) continue;
      Eigen::Vector3i corners = faces_.col(f);
      const Vec3 before = normal(corners);
      const Real shape_before = shape(x_.col(corners[0]), x_.col(corners[1]), x_.col(corners[2]));
      for (int k = 0; k < 3; ++k)
        if (corners[k] == gone) corners[k] = kept;
      const Vec3 after = normal(corners);
      if (after.dot(before) < least_cosine * after.norm() * before.norm()) return false;
      if (shape(x_.col(corners[0]), x_.col(corners[1]), x_.col(corners[2])) < std::min(least_shape, shape_before))
        return false;
    }
    return true;
  }

  void collapse(Index gone, Index kept) {
    for (const Index f : around_[at(gone)]) {
      if (touches(f, kept)) {
        alive_[at(f)] = 0;
        for (int k = 0; k < 3; ++k)
          if (faces_(k, f) != gone) std::erase(around_[at(faces_(k, f))], f);
        continue;
      }
      for (int k = 0; k < 3; ++k)
        if (faces_(k, f) == gone) faces_(k, f) = kept;
      around_[at(kept)].push_back(f);
    }
    around_[at(gone)].clear();
    went_to_[at(gone)] = kept;
    quadrics_[at(kept)] += quadrics_[at(gone)];
    const std::vector<Index> ring = neighbors(kept);
    ++versions_[at(kept)], ++versions_[at(gone)];
    for (const Index v : ring) offer(kept, v);
  }

  CoarseSurface what_is_left() const {
    CoarseSurface coarse;
    std::vector<Index> number(around_.size(), -1);
    for (std::size_t v = 0; v < around_.size(); ++v) {
      if (around_[v].empty()) continue;
      number[v] = static_cast<Index>(coarse.vertices.size());
      coarse.vertices.push_back(static_cast<Index>(v));
    }
    for (std::size_t v = 0; v < around_.size(); ++v) {
      Index end = static_cast<Index>(v);
      while (went_to_[at(end)] != end) end = went_to_[at(end)];
      coarse.went_to.push_back(number[at(end)]);
    }
    coarse.faces.resize(3, std::count(alive_.begin(), alive_.end(), 1));
    Index next = 0;
    for (Index f = 0; f < faces_.cols(); ++f) {
      if (!alive_[at(f)]) continue;
      for (int k = 0; k < 3; ++k) coarse.faces(k, next) = number[at(faces_(k, f))];
      ++next;
    }
    return coarse;
  }

  const Points& x_;
  Eigen::Matrix3Xi faces_;
  std::span<const Index> labels_;
  std::vector<char> alive_;
  std::vector<std::vector<Index>> around_;  ///< faces around each vertex
  std::vector<Quadric> quadrics_;
  std::vector<char> border_;
  std::vector<int> versions_;
  std::vector<Index> went_to_;  ///< itself while it is left
  std::vector<std::pair<Index, Index>> edges_;
  std::priority_queue<Collapse> queue_;
};

/// All of a surface, as if decimated.
CoarseSurface whole(const TriangleMesh& mesh) {
  CoarseSurface coarse{std::vector<Index>(static_cast<std::size_t>(mesh.vertex_count())), mesh.faces, {}};
  std::iota(coarse.vertices.begin(), coarse.vertices.end(), 0);
  coarse.went_to = coarse.vertices;
  return coarse;
}

}  // namespace

CoarseSurface decimate(const TriangleMesh& mesh, Index vertex_count, std::span<const Index> labels) {
  if (mesh.vertex_count() <= vertex_count || mesh.face_count() == 0) return whole(mesh);
  return Decimation(mesh, labels).reduce_to(vertex_count);
}

Points picked(const Points& points, const std::vector<Index>& vertices) {
  Points result(3, static_cast<Index>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i) result.col(static_cast<Index>(i)) = points.col(vertices[i]);
  return result;
}

}  // namespace gracilis
