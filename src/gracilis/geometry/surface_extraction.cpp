#include <gracilis/geometry/surface_extraction.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/disjoint_sets.hpp>
#include <gracilis/geometry/surface_remeshing.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace gracilis {

namespace {

constexpr Index block = 6;  // nodes along the edge of a block that sampling treats as one

/// Fills the block of nodes that begins at `first`: one value where the surface cannot pass, each node's own elsewhere.
void sample_block(const ImplicitSolid& solid, const Eigen::Vector3i& first, SampledSolid& grid) {
  const Eigen::Vector3i last = (first + Eigen::Vector3i::Constant(block)).cwiseMin(grid.nodes);
  const Vec3 low = grid.origin + grid.step * first.cast<Real>();
  const Vec3 high = grid.origin + grid.step * (last - Eigen::Vector3i::Ones()).cast<Real>();
  const Real half = (high - low).norm() / 2;
  const Real center = solid.distance((low + high) / 2);
  // One step more than the block, because cells reach to the next block's first nodes; the factor allows for blends,
  // where the function may grow faster than distance.
  const bool uniform = std::abs(center) > 1.3 * (half + std::sqrt(3.0) * grid.step);
  for (Index k = first.z(); k < last.z(); ++k)
    for (Index j = first.y(); j < last.y(); ++j)
      for (Index i = first.x(); i < last.x(); ++i) {
        const Index node = (k * grid.nodes.y() + j) * grid.nodes.x() + i;
        grid.values[node] = uniform ? center - std::copysign(half, center) : solid.distance(grid.node(node));
      }
}

/// Builds the surface: one vertex per crossed edge of the tetrahedra, found again through the edge's lower node and
/// direction.
class Extractor {
 public:
  explicit Extractor(const SampledSolid& solid)
      : solid_(solid),
        stride_{1, solid.nodes.x(), solid.nodes.x() * solid.nodes.y()},
        vertex_on_edge_(static_cast<std::size_t>(7) * solid.node_count(), -1) {}

  TriangleMesh run() {
    for (Index k = 0; k + 1 < solid_.nodes.z(); ++k)
      for (Index j = 0; j + 1 < solid_.nodes.y(); ++j)
        for (Index i = 0; i + 1 < solid_.nodes.x(); ++i) cell(i * stride_[0] + j * stride_[1] + k * stride_[2]);
    TriangleMesh mesh;
    mesh.vertices = Eigen::Map<const Points>(points_.data(), 3, static_cast<Index>(points_.size()) / 3);
    mesh.faces = Eigen::Map<const Eigen::Matrix3Xi>(faces_.data(), 3, static_cast<Index>(faces_.size()) / 3);
    return mesh;
  }

 private:
  bool inside(Index node) const { return solid_.values[node] < 0; }

  void cell(Index corner) {
    int inside_count = 0;
    for (int bits = 0; bits < 8; ++bits) inside_count += inside(corner + offset(bits));
    if (inside_count == 0 || inside_count == 8) return;
    // Each of the six paths from corner 0 to corner 7 along the axes spans a tetrahedron; odd permutations are
    // left-handed.
    static constexpr std::array<std::array<int, 2>, 6> paths = {{{1, 3}, {2, 6}, {4, 5}, {2, 3}, {1, 5}, {4, 6}}};
    for (int path = 0; path < 6; ++path) {
      std::array<int, 4> corners = {0, paths[path][0], paths[path][1], 7};
      if (path >= 3) std::swap(corners[1], corners[2]);
      tetrahedron(corner, corners);
    }
  }

  Index offset(int bits) const {
    return (bits & 1) * stride_[0] + ((bits >> 1) & 1) * stride_[1] + ((bits >> 2) & 1) * stride_[2];
  }

  /// The vertex where the surface crosses the edge between two corners of a cell (one's bits contain the other's).
  Index vertex(Index cell_corner, int a, int b) {
    if (a > b) std::swap(a, b);
    const Index low = cell_corner + offset(a);
    Index& found = vertex_on_edge_[static_cast<std::size_t>(7) * low + (b - a - 1)];
    if (found >= 0) return found;
    const Index high = cell_corner + offset(b);
    const Real from = solid_.values[low], to = solid_.values[high];
    const Real t = std::clamp(from / (from - to), 0.01, 0.99);
    const Vec3 point = (1 - t) * solid_.node(low) + t * solid_.node(high);
    found = static_cast<Index>(points_.size() / 3);
    points_.insert(points_.end(), point.data(), point.data() + 3);
    return found;
  }

  void face(Index a, Index b, Index c) { faces_.insert(faces_.end(), {a, b, c}); }

  /// `corners` is positively oriented: the first looks at the other three turning clockwise.
  void tetrahedron(Index cell_corner, const std::array<int, 4>& corners) {
    std::array<int, 4> in{}, out{};
    int in_count = 0, out_count = 0;
    bool odd = false;  // parity of the order (inside corners, outside corners)
    for (int i = 0; i < 4; ++i) {
      if (inside(cell_corner + offset(corners[i]))) {
        odd ^= (out_count % 2) != 0;
        in[in_count++] = corners[i];
      } else {
        out[out_count++] = corners[i];
      }
    }
    const auto at = [&](int i, int o) { return vertex(cell_corner, i, o); };
    if (in_count == 1) {
      const Index a = at(in[0], out[0]), b = at(in[0], out[1]), c = at(in[0], out[2]);
      odd ? face(a, c, b) : face(a, b, c);
    } else if (in_count == 3) {
      const Index a = at(in[0], out[0]), b = at(in[1], out[0]), c = at(in[2], out[0]);
      odd ? face(a, c, b) : face(a, b, c);
    } else if (in_count == 2) {
      const Index a = at(in[0], out[0]), b = at(in[0], out[1]), c = at(in[1], out[1]), d = at(in[1], out[0]);
      odd ? (face(a, c, b), face(a, d, c)) : (face(a, b, c), face(a, c, d));
    }
  }

  const SampledSolid& solid_;
  std::array<Index, 3> stride_;
  std::vector<Index> vertex_on_edge_;
  std::vector<Real> points_;
  std::vector<Index> faces_;
};

}  // namespace

Vec3 SampledSolid::node(Index index) const {
  const Index i = index % nodes.x(), j = index / nodes.x() % nodes.y(), k = index / (nodes.x() * nodes.y());
  return origin + step * Vec3(i, j, k);
}

SampledSolid sample(const ImplicitSolid& solid, Real step) {
  assert(step > 0);
  SampledSolid grid;
  grid.step = step;
  grid.origin = solid.bounds.min() - Vec3::Constant(2 * step);
  grid.nodes = ((solid.bounds.sizes() / step).array().ceil().cast<int>() + 5).matrix();
  grid.values.resize(grid.node_count());
  const Eigen::Vector3i blocks = (grid.nodes.array() + block - 1) / block;
  parallel_for(blocks.prod(), 16, [&](Index begin, Index end) {
    for (Index b = begin; b < end; ++b)
      sample_block(solid,
                   block * Eigen::Vector3i(b % blocks.x(), b / blocks.x() % blocks.y(), b / (blocks.x() * blocks.y())),
                   grid);
  });
  return grid;
}

Real interpolate(const SampledSolid& solid, const Vec3& point, Vec3* gradient) {
  const Vec3 last = (solid.nodes - Eigen::Vector3i::Ones()).cast<Real>();
  const Vec3 local = ((point - solid.origin) / solid.step).cwiseMax(0.0).cwiseMin(last);
  const Eigen::Vector3i cell = local.cast<int>().cwiseMin(solid.nodes - Eigen::Vector3i::Constant(2));
  const Vec3 t = local - cell.cast<Real>();
  const Index nx = solid.nodes.x(), nxy = nx * solid.nodes.y();
  const Real* v = solid.values.data() + cell.z() * nxy + cell.y() * nx + cell.x();
  const auto mix = [](Real a, Real b, Real s) { return a + s * (b - a); };
  // Along x, then y, then z.
  const Real x00 = mix(v[0], v[1], t.x()), x10 = mix(v[nx], v[nx + 1], t.x());
  const Real x01 = mix(v[nxy], v[nxy + 1], t.x()), x11 = mix(v[nxy + nx], v[nxy + nx + 1], t.x());
  const Real y0 = mix(x00, x10, t.y()), y1 = mix(x01, x11, t.y());
  if (gradient) {
    const Real dx0 = mix(v[1] - v[0], v[nx + 1] - v[nx], t.y());
    const Real dx1 = mix(v[nxy + 1] - v[nxy], v[nxy + nx + 1] - v[nxy + nx], t.y());
    *gradient = Vec3(mix(dx0, dx1, t.z()), mix(x10 - x00, x11 - x01, t.z()), y1 - y0) / solid.step;
  }
  return mix(y0, y1, t.z());
}

TriangleMesh extract_surface(const SampledSolid& solid) { return Extractor(solid).run(); }

TriangleMesh largest_component(const TriangleMesh& mesh) {
  DisjointSets components(mesh.vertex_count());
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int c = 1; c < 3; ++c) components.join(mesh.faces(c, f), mesh.faces(0, f));

  std::vector<Index> faces_of(mesh.vertex_count(), 0);
  for (Index f = 0; f < mesh.face_count(); ++f) ++faces_of[components.find(mesh.faces(0, f))];
  const Index largest = static_cast<Index>(std::max_element(faces_of.begin(), faces_of.end()) - faces_of.begin());

  TriangleMesh result;
  std::vector<Index> renumbered(mesh.vertex_count(), -1);
  Index kept = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (components.find(v) == largest) renumbered[v] = kept++;
  result.vertices.resize(3, kept);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (renumbered[v] >= 0) result.vertices.col(renumbered[v]) = mesh.vertices.col(v);
  result.faces.resize(3, mesh.vertex_count() > 0 ? faces_of[largest] : 0);
  kept = 0;
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (renumbered[mesh.faces(0, f)] >= 0)
      result.faces.col(kept++) = mesh.faces.col(f).unaryExpr([&](Index v) { return renumbered[v]; });
  return result;
}

void project_to_surface(TriangleMesh& mesh, const SampledSolid& solid) {
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 start = mesh.vertices.col(v);
    Vec3 point = start, gradient;
    for (int iteration = 0; iteration < 4; ++iteration) {
      const Real value = interpolate(solid, point, &gradient);
      // A gradient much flatter than a distance's marks a medial line; do not let it throw the vertex.
      point -= value / std::max(gradient.squaredNorm(), 0.25) * gradient;
    }
    Vec3 move = point - start;
    const Real length = move.norm();
    if (length > solid.step) move *= solid.step / length;
    mesh.vertices.col(v) = start + move;
  }
}

TriangleMesh mesh_solid(const ImplicitSolid& solid, Real step, Real edge_length) {
  const SampledSolid grid = sample(solid, step);
  return remesh(largest_component(extract_surface(grid)), grid, edge_length);
}

}  // namespace gracilis
