#include <gracilis/methods/pbd/surface.hpp>

#include <gracilis/anatomy/fibers/nearest_fiber.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/coloring.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/pbd/constraints.hpp>

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>

namespace gracilis::pbd {

namespace {

/// Constraints that one task projects.
constexpr Index grain = 1024;

template <class Constraint>
Colored<Constraint> color(const std::vector<Constraint>& constraints, const ConstraintGraph& graph) {
  const std::vector<Index> colors = color_constraints(graph);
  std::vector<std::size_t> order(constraints.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return colors[a] < colors[b]; });
  Colored<Constraint> result;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && colors[order[i]] != colors[order[i - 1]]) result.begins.push_back(static_cast<Index>(i));
    result.constraints.push_back(constraints[order[i]]);
  }
  if (!order.empty()) result.begins.push_back(static_cast<Index>(order.size()));
  return result;
}

/// Calls act(constraint) for all, those of one color side by side.
template <class Constraint, class Act>
void for_each_by_color(const Colored<Constraint>& colored, const Act& act) {
  for (std::size_t c = 0; c + 1 < colored.begins.size(); ++c) {
    const Index first = colored.begins[c], count = colored.begins[c + 1] - first;
    parallel_for(count, grain, [&](Index begin, Index end) {
      for (Index i = first + begin; i < first + end; ++i) act(colored.constraints[static_cast<std::size_t>(i)]);
    });
  }
}

template <std::size_t count>
std::array<Vec3, count> places(const std::array<Index, count>& vertices, const Points& points) {
  std::array<Vec3, count> result;
  for (std::size_t i = 0; i < count; ++i) result[i] = points.col(vertices[i]);
  return result;
}

/// Projects one constraint; false where it had no gradient.
template <std::size_t count>
bool move(const Surface& surface, const std::array<Index, count>& vertices, const Evaluated<count>& constraint,
          Real stiffness, Points& points, Real limit = std::numeric_limits<Real>::infinity()) {
  std::array<Vec3, count> moved = places(vertices, points);
  std::array<Real, count> weight{};
  std::array<Vec3*, count> pointers{};
  for (std::size_t i = 0; i < count; ++i) {
    weight[i] = surface.weight[static_cast<std::size_t>(vertices[i])];
    pointers[i] = &moved[i];
  }
  if (!project(constraint, stiffness, weight, pointers, limit)) return constraint.has_gradient;
  for (std::size_t i = 0; i < count; ++i)
    if (weight[i] > 0) points.col(vertices[i]) = moved[i];
  return true;
}

}  // namespace

Surface build_surface(const TriangleMesh& mesh, const MeshTopology& topology, const std::vector<Index>& fixed_body,
                      const Polylines& fibers) {
  const Points& rest = mesh.vertices;
  const NearestFiber nearest(fibers);
  Surface surface;
  for (const Index body : fixed_body) surface.weight.push_back(body < 0 ? 1 : 0);
  std::vector<EdgeConstraint> edges;
  std::vector<DihedralConstraint> dihedrals;
  ConstraintGraph edge_graph{2, mesh.vertex_count(), {}}, dihedral_graph{4, mesh.vertex_count(), {}};
  for (const MeshEdge& edge : topology.edges) {
    const Vec3 a = rest.col(edge.a), b = rest.col(edge.b);
    const bool is_held =
        fixed_body[static_cast<std::size_t>(edge.a)] >= 0 && fixed_body[static_cast<std::size_t>(edge.b)] >= 0;
    if (!is_held) {
      edges.push_back(
          {edge.a, edge.b, (b - a).norm(), anisotropy((b - a).normalized(), nearest.direction((a + b) / 2))});
      edge_graph.particles.insert(edge_graph.particles.end(), {edge.a, edge.b});
    }
    const std::array<Index, 4> vertices = {edge.a, edge.b, edge.left_apex, edge.right_apex};
    if (edge.left < 0 || edge.right < 0) continue;
    if (std::none_of(vertices.begin(), vertices.end(),
                     [&](Index v) { return fixed_body[static_cast<std::size_t>(v)] < 0; }))
      continue;
    dihedrals.push_back(
        {vertices, arccos_angle(a, b, rest.col(edge.left_apex), rest.col(edge.right_apex)), (b - a).norm()});
    dihedral_graph.particles.insert(dihedral_graph.particles.end(), vertices.begin(), vertices.end());
  }
  surface.edges = color(edges, edge_graph);
  surface.dihedrals = color(dihedrals, dihedral_graph);
  surface.faces = mesh.faces;
  surface.corners = group_by_key({mesh.faces.data(), static_cast<std::size_t>(mesh.faces.size())}, mesh.vertex_count());
  surface.volume = enclosed_volume(rest, mesh.faces);
  return surface;
}

Index project_edges_and_angles(const Surface& surface, const Stiffness& stiffness, Points& points) {
  for_each_by_color(surface.edges, [&](const EdgeConstraint& edge) {
    const Evaluated<2> evaluated = distance_constraint(points.col(edge.a), points.col(edge.b), edge.length);
    move<2>(surface, {edge.a, edge.b}, evaluated, stiffness.edges * edge.anisotropy, points);
  });
  std::atomic<Index> skipped = 0;
  for_each_by_color(surface.dihedrals, [&](const DihedralConstraint& dihedral) {
    const auto [a, b, c, d] = places(dihedral.vertices, points);
    const Real limit = stiffness.dihedral_limit > 0 ? stiffness.dihedral_limit * dihedral.edge_length
                                                    : std::numeric_limits<Real>::infinity();
    if (!move<4>(surface, dihedral.vertices, angle_constraint(a, b, c, d, dihedral.angle), stiffness.angles, points,
                 limit))
      skipped.fetch_add(1, std::memory_order_relaxed);
  });
  return skipped;
}

Real volume_constraint(const Surface& surface, const Points& points, Points& gradient) {
  gradient.resize(3, points.cols());
  parallel_for(static_cast<Index>(points.cols()), grain, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) {
      Vec3 sum = Vec3::Zero();
      const Vec3 here = points.col(v);
      for (const Index corner : surface.corners.with(v)) {
        const Index face = corner / 3, row = corner % 3;
        const Vec3 next = points.col(surface.faces((row + 1) % 3, face));
        const Vec3 last = points.col(surface.faces((row + 2) % 3, face));
        sum += (next - here).cross(last - here);  // around a closed ring this is the sum of next × last
      }
      gradient.col(v) = sum / 6;
    }
  });
  return enclosed_volume(points, surface.faces) - surface.volume;
}

void project_volume(const Surface& surface, Real stiffness, Points& points) {
  Points gradient;
  const Real off = volume_constraint(surface, points, gradient);
  Real sum = 0;
  for (Index v = 0; v < static_cast<Index>(points.cols()); ++v)
    sum += surface.weight[static_cast<std::size_t>(v)] * gradient.col(v).squaredNorm();
  if (!(sum > 0)) return;
  for (Index v = 0; v < static_cast<Index>(points.cols()); ++v)
    points.col(v) -= stiffness * off * surface.weight[static_cast<std::size_t>(v)] / sum * gradient.col(v);
}

}  // namespace gracilis::pbd
